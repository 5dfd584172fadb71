/* The belt that leads: it runs, slows down for a jam further on, and runs again. */
VEL 100
ACC 40
DEC 40
CVEL 40
CSTART
WAITT 4000
CVEL 15
WAITT 2000
CVEL 60
rest:
  DELAY 1000
GOTO rest
