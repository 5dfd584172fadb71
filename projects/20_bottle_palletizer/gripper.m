/* Opens and closes by relative positions: 1900 counts. */
ON ERROR GOSUB trouble
VEL 50
ACC 100
DEC 100

again:
  WAITI 1 ON
  POSR (GET 1900)
  OUT 1 1
  WAITI 2 ON
  POSR (-(GET 1900))
  OUT 1 0
  WAITI 2 OFF
GOTO again

SUBMAINPROG
SUBPROG trouble
  PRINT "gripper: error ", ERRNO
  DELAY 500
  ERRCLR
  CONTINUE
RETURN
ENDPROG
