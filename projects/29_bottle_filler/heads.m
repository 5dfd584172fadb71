/* The filler heads run along with the bottles and fill where they are in step.
   Words that come: 1 bit 1 go along, bit 2 clear an error
   Words that go:   1 SYNCSTAT, bit 9 an error; 2 bottles filled; 3 bottles that were missing; 4 number of the error
   Output 1: the valves are open */
ON ERROR GOSUB trouble
ON STATBIT 30 GOSUB missing            // a master marker did not come
VEL 100
ACC 100
DEC 100
filled = 0
lost = 0
along = 0

main:
  IF (PCD[1].1 == 1) AND (along == 0) THEN
    SYNCM
    along = 1
  ELSEIF (PCD[1].1 == 0) AND (along == 1) THEN
    OUT 1 0
    MOTOR STOP
    along = 0
  ENDIF
  state = SYNCSTAT
  in_step = along * (state.1)
  OUT 1 in_step
  IF (state.4 == 1) THEN                 // a marker within its window, which MIPOS alone does not tell
    filled = filled + in_step
    SYNCSTATCLR 8
  ENDIF
  PCD[1] = state
  PCD[2] = filled
  PCD[3] = lost
GOTO main

SUBMAINPROG
SUBPROG missing
  lost = lost + 1
RETURN

SUBPROG trouble
  OUT 1 0
  PCD[4] = ERRNO
  PCD[1] = 256
  WHILE (PCD[1].2 == 0) DO
  ENDWHILE
  ERRCLR
  PCD[4] = 0
  along = 0
RETURN
ENDPROG
