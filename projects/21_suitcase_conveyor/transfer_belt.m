/* The belt behind it takes suitcases over at the speed of the one in front, or runs by hand.
   Inputs:  1 follow, 2 by hand, 3 faster, 4 slower, 8 clear an error
   Outputs: 1 follows, 2 by hand, 8 error
   1900: velocity by hand, 1901: step of it */
ON ERROR GOSUB trouble
VEL 100
ACC 100
DEC 100
LINKGPAR 1900 "Manual velocity" 0 100 0
LINKGPAR 1901 "Velocity step" 0 10 0
follows = 0
pressed = 0
velocity = 0

main:
  IF (IN 1 == 1) THEN
    IF (follows == 0) THEN          // once: saying it again would begin anew
      SYNCV
      follows = 1
      OUT 1 1
    ENDIF
  ELSEIF (follows == 1) THEN
    MOTOR STOP
    follows = 0
    OUT 1 0
  ENDIF
  IF (IN 2 == 1) AND (follows == 0) THEN
    GOSUB by_hand
  ENDIF
GOTO main

SUBMAINPROG
SUBPROG by_hand
  OUT 2 1
  velocity = GET 1900
  CVEL velocity
  CSTART
  WHILE (IN 2 == 1) DO
    faster = IN 3                    // read once: an input may change between two lines
    slower = IN 4
    IF (faster == 1) AND (pressed == 0) THEN
      velocity = velocity + GET 1901
      CVEL velocity
    ELSEIF (slower == 1) AND (pressed == 0) THEN
      velocity = velocity - GET 1901
      CVEL velocity
    ENDIF
    pressed = faster | slower
  ENDWHILE
  CSTOP
  WAITAX
  OUT 2 0
RETURN

SUBPROG trouble
  OUT 8 1
  OUT 1 0
  OUT 2 0
  waits = 1
  WHILE waits DO                     // until it is cleared while nothing else is asked for
    IF (IN 8) AND NOT (IN 1) AND NOT (IN 2) THEN
      ERRCLR
      waits = 0
    ENDIF
  ENDWHILE
  OUT 8 0
  follows = 0
RETURN
ENDPROG
