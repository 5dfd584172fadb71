/* Down until the touch probe sees the box, and 1900 further; 1901 is the height of the pallet. In 1/10 mm. */
ON ERROR GOSUB trouble
ON INT 3 GOSUB probe
seeks = 0
found = 0
VEL 60
ACC 100
DEC 100

again:
  WAITI 1 ON
  GOSUB down
  OUT 1 1
  WAITI 4 ON
  OUT 1 0
  POSA 0
  OUT 3 1
  WAITI 2 ON
  OUT 3 0
  POSA (GET 1901)
  OUT 2 1
  WAITI 4 OFF
  OUT 2 0
  POSA 0
  OUT 4 1
  WAITI 2 OFF
  OUT 4 0
GOTO again

SUBMAINPROG
SUBPROG down
  found = 0
  seeks = 1
  CVEL 20
  CSTART
  WHILE (found == 0) DO
  ENDWHILE
  WAITAX
RETURN

SUBPROG probe
  IF (seeks == 1) THEN
    seeks = 0
    POSR (GET 1900)
    found = 1
  ENDIF
RETURN

SUBPROG trouble
  PRINT "vertical: error ", ERRNO
  DELAY 500
  ERRCLR
  CONTINUE
RETURN
ENDPROG
