/* The belt with the boxes. */
VEL 100
ACC 20
DEC 20
CVEL 20
CSTART
rest:
  DELAY 1000
GOTO rest
