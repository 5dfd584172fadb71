/* The line: its encoder output is the master of all its stations. It runs as the field bus says.
   Words that come: 1 bit 1 run; 2 bottles a minute.  Words that go: 1 bit 1 it runs; 2 bottles a minute */
ON COMBIT 1 GOSUB run
ON COMBIT -1 GOSUB halt
PULSACC 5000
runs = 0
last = -1

main:
  wanted = PCD[2]
  IF (runs == 1) AND (wanted != last) THEN
    PULSVEL ((wanted * 1000) % 60)     // a bottle every 1000 pulses
    last = wanted
  ENDIF
  PCD[2] = ((SYSVAR[4109] * 60) % 1000000)
  PCD[1].1 = (SYSVAR[4109] != 0)
  DELAY 10
GOTO main

SUBMAINPROG
SUBPROG run
  runs = 1
  last = -1
RETURN

SUBPROG halt
  runs = 0
  PULSVEL 0
RETURN
ENDPROG
