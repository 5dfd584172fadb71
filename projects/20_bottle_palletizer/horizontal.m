/* The carriage between the boxes and the pallet: absolute positions in 1/10 mm, of which 1900 is the pallet. */
ON ERROR GOSUB trouble
LINKGPAR 1900 "Pallet" 500 3000 0
boxes = 0
VEL 80
ACC 100
DEC 100
HOME

again:
  POSA 0
  OUT 1 1
  WAITI 1 ON
  OUT 1 0
  POSA (GET 1900)
  OUT 2 1
  WAITI 2 ON
  OUT 2 0
  boxes = boxes + 1
  PRINT "box ", boxes, " at ", APOS
GOTO again

SUBMAINPROG
SUBPROG trouble
  PRINT "horizontal: error ", ERRNO
  OUT 1 0
  OUT 2 0
  DELAY 500
  ERRCLR
  CONTINUE
RETURN
ENDPROG
