// What each command of the language does.
#include <string_view>

#include "scheduler/aposs/commands.hpp"

namespace lockstep::aposs {
namespace {

struct Meaning {
  std::string_view name;
  std::string_view text;
};

constexpr Meaning kMeanings[] = {
    {"ACC",
     "Stores the acceleration that every later motion (positioning, speed mode, "
     "synchronising) uses. The figure is relative: VELRES (default 100) means 'reach VELMAX "
     "within RAMPMIN'. Stays valid until the next ACC"},
    {"APOS", "Reads the measured axis position, converted from quad-counts with the user-unit factor"},
    {"AVEL", "Reads the axis velocity as position difference over a measuring window"},
    {"AXEND",
     "Returns the state of the axis/programmed motion; used to poll for the end of a motion "
     "that was started with NOWAIT ON"},
    {"COMOPTGET",
     "Copies received fieldbus process words from the communication option into an array, "
     "one word per element"},
    {"COMOPTSEND", "Copies the first 'no' array elements into the send buffer of the communication option"},
    {"CONTINUE",
     "Resumes a positioning or speed motion that was interrupted by MOTOR STOP, by an error "
     "or by MOTOR OFF"},
    {"CPOS",
     "Reads the set position that the profile generator recomputes every millisecond, in "
     "every operating state (standstill, positioning, speed, synchronising)"},
    {"CSTART", "Switches to speed mode and ramps to the velocity of the last CVEL using ACC/DEC"},
    {"CSTOP", "Leaves speed mode: decelerates with DEC, then holds position in positioning mode"},
    {"CURVEPOS",
     "Evaluates the active curve at the current curve master position; independent of where "
     "the slave actually is"},
    {"CVEL", "Sets the speed-mode velocity; stays valid until the next CVEL"},
    {"DEC", "Like ACC, for slowing down"},
    {"DEFMCPOS",
     "Assigns a curve master position to the present physical master position, whatever "
     "MAPOS is; fixes where in the curve counting starts"},
    {"DEFMORIGIN",
     "Makes the present master position the master zero point; MAPOS refers to it until "
     "DEFMORIGIN/SETMORIGIN is used again"},
    {"DEF ORIGIN", "Makes the present slave position the real zero point for absolute positioning"},
    {"DEF SYNCORIGIN",
     "Defines the master/slave position pair that the next SYNCP or SYNCM has to bring "
     "together. Internally the slave command position is set to the slave value and the "
     "master value is used as an internal MOVESYNCORIGIN"},
    {"DELAY",
     "Halts program flow for t ms; interrupts are served meanwhile and their run time "
     "counts as part of the delay"},
    {"DELETE ARRAYS", "Removes all arrays from RAM without touching parameters or programs"},
    {"DIM",
     "Declares global, non-volatile 32-bit arrays. Missing arrays are created, existing "
     "ones are checked for equal size in declaration order"},
    {"DISABLE", "Blocks execution of an interrupt class (or all). ON ERROR can never be blocked"},
    {"ENABLE", "Lifts a block set by DISABLE for exactly that class (ALL only lifts ALL)"},
    {"ERRCLR",
     "Clears the option's present error, also resets drive alarms (bit 7 of the control "
     "word) and includes MOTOR ON: control is resumed with the set position equal to the "
     "actual position"},
    {"ERRNO", "System variable with the present error code"},
    {"EXIT", "Ends the program prematurely; active positioning motions are completed"},
    {"GET", "Reads an MCO or application parameter"},
    {"GETVLT", "Reads a drive parameter"},
    {"GETVLTSUB", "Reads an indexed drive parameter"},
    {"GOSUB", "Calls a subroutine; execution continues after the call on RETURN"},
    {"GOTO", "Unconditional jump"},
    {"HOME",
     "Runs to the reference switch with HOME_VEL/HOME_RAMP, finishes according to HOME_TYPE "
     "and defines the reached position as zero (after moving to HOME_OFFSET)"},
    {"IF", "Conditional branches; the first true branch runs, the rest is skipped"},
    {"IN", "Reads one digital input"},
    {"INAD", "Reads an analog input of the drive"},
    {"INB", "Reads eight digital inputs at once"},
    {"INDEX", "Runs to the encoder index with HOME_VEL (sign = direction)"},
    {"INKEY", "Reads the control-panel keys"},
    {"IPOS",
     "Returns the last slave index/marker position relative to the active zero point. The "
     "position is latched in hardware, accurate to +/-1 qc, and then copied into the "
     "variable"},
    {"LINKGPAR",
     "Publishes an application parameter on the panel with name, limits and activation "
     "mode; clamps the stored value into the limits"},
    {"LINKSYSVAR", "Shows a system variable on the panel"},
    {"LOOP",
     "Jumps back n times; the body is executed n+1 times because the counter is tested at "
     "the end"},
    {"MAPOS", "Reads the actual master position"},
    {"MAVEL", "Reads the master velocity"},
    {"MIPOS", "Like IPOS for the master encoder"},
    {"MOTOR OFF", "Switches the position controller off; axis can move freely, position is still counted"},
    {"MOTOR ON", "Switches the controller on with set position := actual position (following error 0)"},
    {"MOTOR STOP",
     "Decelerates any positioning, speed or synchronising motion with the programmed "
     "deceleration and holds position"},
    {"MOVESYNCORIGIN",
     "Shifts the synchronisation origin relative to its last value (SYNCPOSOFFS sets it "
     "absolutely); avoids number overflow when shifting continuously"},
    {"NOWAIT", "Selects whether POSA/POSR (and MOTOR STOP) block the program"},
    {"ON APOS", "Calls a subroutine every time the slave position is passed in the given direction"},
    {"ON COMBIT", "Calls a subroutine when a fieldbus bit becomes set"},
    {"ON DELETE",
     "Deletes every position interrupt that is linked to the named subroutine; other "
     "interrupt kinds with the same subroutine stay"},
    {"ON ERROR GOSUB",
     "Installs an error handler. On error the program is not aborted; the handler is called "
     "and, on RETURN, execution continues at the interrupted place"},
    {"ON INT", "Calls a subroutine on an input edge"},
    {"ON MAPOS", "Calls a subroutine when the master position is passed"},
    {"ON MCPOS",
     "Calls a subroutine when the curve master position is passed, i.e. once per cycle: the "
     "electronic cam box"},
    {"ON PARAM", "Calls a subroutine when a parameter is changed on the panel"},
    {"ON PERIOD",
     "Calls a subroutine at regular intervals; due times are start+k*period, independent of "
     "execution time"},
    {"ON STATBIT", "Calls a subroutine when a status bit becomes set"},
    {"ON TIME", "Calls a subroutine once after n ms; the program goes on meanwhile"},
    {"OUT", "Switches a digital or relay output"},
    {"OUTAN", "Writes the drive reference directly (open-loop operation)"},
    {"OUTB", "Switches eight outputs at once"},
    {"OUTDA", "Drives the analog output of the control card"},
    {"PCD", "Direct access to fieldbus process data without COMOPTGET/SEND"},
    {"PID", "Evaluates a free-standing PID filter with memory"},
    {"POSA",
     "Moves to an absolute position with VEL/ACC/DEC (or 32-84/32-85) and the profile of "
     "RAMPTYPE"},
    {"POSA CURVEPOS",
     "Positions the slave on the curve point that belongs to the present curve master "
     "position"},
    {"POSR", "Moves by a distance relative to the actual position"},
    {"PRINT", "Writes to the PC communication window; a trailing semicolon suppresses the line feed"},
    {"PRINT DEV", "Redirects or silences all later PRINTs without DEV"},
    {"PULSACC", "Sets the ramp of the virtual master (encoder simulation)"},
    {"PULSVEL", "Starts/changes the virtual master velocity"},
    {"REPEAT", "Loop tested at the end; body runs at least once"},
    {"RST ORIGIN", "Removes the temporary zero point of SET ORIGIN"},
    {"SAVE",
     "Stores arrays (ARRAYS), global + application parameters (GLBPARS; groups given as "
     "30-5*, 33-8* and 19-**), the other axis parameters (AXPARS) or application parameters "
     "only (USRPARS) in EEPROM"},
    {"SAVEPROM", "Stores programs, arrays and application parameters in EEPROM"},
    {"SET", "Changes a parameter temporarily"},
    {"SETCURVE",
     "Selects and pre-computes the active curve; required before CURVEPOS, SYNCCxx, "
     "SYNCCSTART, SYNCCSTOP"},
    {"SETMORIGIN", "Sets an arbitrary position as master zero point; replaces DEFMORIGIN"},
    {"SET ORIGIN", "Sets a temporary zero point for absolute positioning and position read-outs"},
    {"SETVLT", "Changes a drive parameter in RAM"},
    {"SETVLTSUB", "Changes an indexed drive parameter in RAM"},
    {"STAT", "Reads axis and control status"},
    {"SUBMAINPROG", "Encloses the only subroutine area of a program"},
    {"SUBPROG", "Defines a subroutine (no parameters, all variables global)"},
    {"SWAPMENC",
     "Exchanges the roles of the master and slave encoder inputs so that two motors can be "
     "run alternately"},
    {"SYNCC",
     "Enters CAM mode: the curve master position is counted from now on (or, with "
     "SYNCMSTART 2000, from the next master marker). Does not move the slave and does not "
     "interrupt a running motion; that is SYNCCSTART's job"},
    {"SYNCCMM",
     "CAM mode with correction of the curve master position by master markers (only while "
     "the master moves forward). SYNCMPULSM is the distance sensor - working point; larger "
     "than one cycle creates a FIFO"},
    {"SYNCCMS", "CAM mode with correction of the slave position by slave markers; no FIFO"},
    {"SYNCCSTART",
     "Starts the slave: between the two points of the pair the slave is led from its rest "
     "position onto the curve"},
    {"SYNCCSTOP",
     "Disengages the slave over the point pair and stops it at slavepos, without leaving "
     "CAM mode"},
    {"SYNCERR",
     "Distance between the master position (times gear factor plus offset) and the slave "
     "position, including pending filter errors and corrections"},
    {"SYNCM",
     "Position synchronisation plus marker correction: at every evaluated marker (every "
     "n-th per SYNCMARKM/S) the deviation between master and slave marker becomes a new "
     "offset and is compensated within VEL, ACC, DEC"},
    {"SYNCP",
     "Position/angle synchronisation: slave position follows master*SYNCFACTS/SYNCFACTM + "
     "offset. On start the master position is latched and the slave is accelerated so that "
     "it meets the moving target, using its own ramp in the prediction"},
    {"SYNCSTAT", "Synchronisation status flags"},
    {"SYNCSTATCLR", "Clears marker hit/error flags only"},
    {"SYNCV",
     "Velocity synchronisation: slave velocity = filtered master velocity * "
     "SYNCFACTS/SYNCFACTM; positions are not recovered"},
    {"SYSVAR",
     "Pseudo array with internal values; some entries can be written (4105 with simulated "
     "master)"},
    {"TESTSETP", "Configures an on-line data recorder"},
    {"TESTSTART", "Starts recording in the background"},
    {"TIME", "System time"},
    {"TRACKERR", "Following error"},
    {"VEL",
     "Velocity for later positionings and upper limit of the slave velocity in the SYNC "
     "modes"},
    {"WAITAX", "Waits for the end of a positioning started with NOWAIT ON"},
    {"WAITI", "Waits for an input level"},
    {"WAITNDX", "Waits for the next index pulse of the axis; error 179 on time-out"},
    {"WAITP", "Waits until position p is reached or, judged by velocity and position, already passed"},
    {"WAITT", "Waits t ms; an interrupt restarts the whole wait"},
    {"WHILE", "Loop tested at the start"},
    {"_GETVEL", "Changes the averaging window of AVEL and MAVEL (default 20 ms)"},
    {"#INCLUDE", "Compiler directive: inserts a source file"},
    {"DEFCORIGIN", "Sets the commanded position (instead of the actual one) as zero point"},
    {"APOSDIFF", "Overflow-safe distance since an earlier APOS reading of an incremental encoder"},
    {"CPOSDIFF", "Overflow-safe distance since an earlier CPOS reading of an incremental encoder"},
    {"IPOSDIFF", "Overflow-safe distance since an earlier IPOS reading of an incremental encoder"},
    {"MAPOSDIFF", "Overflow-safe distance since an earlier MAPOS reading of an incremental encoder"},
    {"MIPOSDIFF", "Overflow-safe distance since an earlier MIPOS reading of an incremental encoder"},
    {"ENCPOSOFFS",
     "Synchronises the incremental position counter with the absolute one inside the slave "
     "encoder"},
    {"MENCPOSOFFS", "As ENCPOSOFFS for the master encoder"},
    {"ENCTGREAD", "Reads an RS485 telegram from the slave encoder"},
    {"ENCTGWRITE", "Sends an RS485 telegram to the slave encoder"},
    {"MENCTGREAD", "As ENCTGREAD for the master encoder"},
    {"MENCTGWRITE", "As ENCTGWRITE for the master encoder"},
    {"JERKFINVEL",
     "Computes the end velocity for a jerk-limited stop with maximum "
     "acceleration/deceleration"},
    {"JERKSTOPDIST", "Computes the distance needed for a jerk-limited stop"},
    {"TESTSETDEST", "Selects where recorded data go"},
    {"TESTSETINDEX", "Selects up to 20 system variables to record (more -> error 195)"},
    {"TESTSETTIME", "Sets the sampling period of the recorder"},
    {"TESTSETTYPE", "Selects single or cyclic recording"},
    {"TESTSTOP", "Ends a recording (needed for cyclic mode)"},
    {"VLTALARMSTAT", "Reports whether a drive alarm is present"},
    {"VLTCONTROL", "Sets the drive control word while in MOTOR OFF"},
    {"VLTERRCLR", "Clears a drive alarm without clearing option errors"},
    {"ON CANINPUT", "Calls a subroutine when a CAN telegram of the type arrives"},
    {"ON CANMSG", "Calls a subroutine when a buffered CAN message arrives"},
    {"ON KEYPRESSED", "Calls a subroutine when a panel key is pressed or released"},
    {"ON IPOS", "Position interrupt at a distance from the last slave marker"},
    {"ON MIPOS", "Position interrupt at a distance from the last master marker"},
    {"ON posint SETOUT",
     "Electronic cam box: switches an output directly at a position without program code"},
    {"ON posint SETOUT TOIN",
     "As SETOUT, linked with an input (the overview gives no further semantics; presumably "
     "the output takes the input's state at the position)"},
    {"LINKPDO", "Maps part of a received PDO into a system variable/parameter/array in the background"},
    {"LINKSDO", "Maps an internal object into a transmitted PDO"},
    {"SYNCMARKERSTART",
     "Resets the markers (0) or the whole marker handling (1) during marker synchronisation; which value "
     "means which is not in the sources"},
    {"CANDEL", "Deletes CAN mailboxes"},
    {"CANIN", "Reads a CAN object"},
    {"CANOUT", "Sends a CAN object"},
    {"DEFCANIN", "Defines a receive mailbox"},
    {"DEFCANOUT", "Defines a transmit mailbox"},
    {"INGLB", "Reads a global CAN message (telegram id 0, 8 bytes, first two bytes must be 0)"},
    {"INMSG", "Reads a buffered message (RxMessage id = CANNR*2+1)"},
    {"MSGVAL", "Returns the long value of the last buffered message"},
    {"OUTMSG", "Sends a buffered message (TxMessage id = CANNR*2); may block when the buffer is full"},
    {"USRSTAT", "Sets the CAN user status"},
    {"CANINI",
     "Registers CANopen nodes for background process data exchange and guarding; 999 "
     "activates extended functions"},
    {"SDOREAD", "Reads an object of another node"},
    {"SDOREADSEG", "Segmented SDO read, unpacked"},
    {"SDOREADSEGP", "Segmented SDO read, packed"},
    {"SDOSTATE", "Polls an asynchronous SDO"},
    {"SDOWRITE", "Writes an object of another node"},
    {"PDO", "Direct access to CANopen PDOs"},
    {"INLONG",
     "Only mentioned in error 115: reads a long from the serial line; an invalid string "
     "raises error 115"},
    {"SWITCH", "Multi-way branch with constants"},
    {"BREAK", "Leaves a switch case or the innermost WHILE/REPEAT loop"},
    {"#pragma", "Forbids/permits implicit declaration of LONG variables; must directly follow DIM"},
    {"function definition",
     "Functions with local variables on the stack; must be declared before use; arrays by "
     "reference"},
    {"double functions", "Floating-point library; casts (long)/(double)"},
    {"preprocessor",
     "Text preprocessor with recursive macro replacement, predefined __DATE__, __TIME__, "
     "__FILE__, __LINE__; directives in lower case"},
};

}  // namespace

std::string_view meaning_of(const CommandRow& row) noexcept {
  for (const Meaning& meaning : kMeanings)
    if (meaning.name == row.name) return meaning.text;
  return "";
}

}  // namespace lockstep::aposs
