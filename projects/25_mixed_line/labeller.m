/* The labeller goes with the belt, two of its counts for each of the belt's, while input 1 is on. */
VEL 100
ACC 100
DEC 100
SET SYNCACCURACY (-20)

main:
  WAITI 1 ON
  SYNCP
  WHILE (IN 1 == 1) DO
    OUT 1 (SYNCSTAT.3)     // accurate
  ENDWHILE
  MOTOR STOP
  OUT 1 0
GOTO main
