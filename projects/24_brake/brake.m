/* The motor holds before the brake opens, and the brake holds before the motor lets go. */
ON ERROR GOSUB trouble
VEL 50
ACC 100
DEC 100
up = 20000

again:
  GOSUB open
  POSR up
  GOSUB shut
  DELAY 200
GOTO again

SUBMAINPROG
SUBPROG open
  MOTOR ON
  DELAY 150
  OUT 3 1
RETURN

SUBPROG shut
  OUT 3 0
  DELAY 100
  MOTOR OFF
RETURN

SUBPROG trouble
  PRINT "error ", ERRNO
  WAITAX
  OUT 3 0
forever:            // EXIT would start the program anew, and with it the motor
  DELAY 1000
  GOTO forever
RETURN
ENDPROG
