/* Teddies are laid into boxes that run beside them.
   Inputs:  1 follow, 2 measure teddies, 3 measure boxes, 4 a step of offset, 7 by markers, 8 clear an error
   Outputs: 1 accurate, 2 measures, 3 ready, 4 a box was missing, 5 fault, 8 error
   1900: step of the offset [qc], 1901: velocity of measuring [%] */
ON ERROR GOSUB trouble
VEL 100
ACC 100
DEC 100
LINKGPAR 1900 "Offset step" 0 10000 0
LINKGPAR 1901 "Measuring velocity" 0 100 0
pressed = 0

main:
  IF (IN 1 == 1) THEN
    GOSUB follow
  ELSEIF (IN 2 == 1) THEN
    GOSUB measure_teddies
  ELSEIF (IN 3 == 1) THEN
    GOSUB measure_boxes
  ENDIF
GOTO main

SUBMAINPROG
SUBPROG follow
  IF (IN 7 == 1) THEN
    SYNCM                              // boxes and teddies as the sensors see them
  ELSE
    SYNCP                              // belt beside belt
  ENDIF
  WHILE (IN 1 == 1) DO
    step = IN 4
    IF (step == 1) AND (pressed == 0) THEN
      MOVESYNCORIGIN (GET 1900)
    ENDIF
    pressed = step
    state = SYNCSTAT
    OUT 1 (state.3)
    OUT 3 (state.1)
    OUT 4 (state.6)
    OUT 5 (state.2)
  ENDWHILE
  MOTOR STOP
  GOSUB dark
RETURN

SUBPROG measure_teddies
  OUT 2 1
  CVEL (GET 1901)
  CSTART
  last = IPOS
  markers = -1                         // the first distance begins anywhere
  sum = 0
  WHILE (IN 2 == 1) DO
    new = IPOS
    IF (new != last) THEN
      IF (markers >= 0) THEN
        sum = sum + abs (new - last)
      ENDIF
      markers = markers + 1
      last = new
    ENDIF
  ENDWHILE
  CSTOP
  WAITAX
  IF (markers > 0) THEN
    SET SYNCMPULSS (sum rnd markers)
    PRINT "a teddy every", GET SYNCMPULSS
  ENDIF
  OUT 2 0
RETURN

SUBPROG measure_boxes
  OUT 2 1
  last = MIPOS
  markers = -1
  sum = 0
  WHILE (IN 3 == 1) DO
    new = MIPOS
    IF (new != last) THEN
      IF (markers >= 0) THEN
        sum = sum + abs (new - last)
      ENDIF
      markers = markers + 1
      last = new
    ENDIF
  ENDWHILE
  IF (markers > 0) THEN
    SET SYNCMPULSM (sum rnd markers)
    PRINT "a box every", GET SYNCMPULSM
  ENDIF
  OUT 2 0
RETURN

SUBPROG dark
  OUT 1 0
  OUT 3 0
  OUT 4 0
  OUT 5 0
RETURN

SUBPROG trouble
  OUT 8 1
  OUT 2 0
  GOSUB dark
  waits = 1
  WHILE waits DO
    IF (IN 8) AND NOT (IN 1) THEN
      ERRCLR
      waits = 0
    ENDIF
  ENDWHILE
  OUT 8 0
RETURN
ENDPROG
