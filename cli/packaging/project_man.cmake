# The man page of the project file, from its schema: cmake -D SCHEMA=… -D VERSION=… -D OUTPUT=… -P project_man.cmake
cmake_minimum_required(VERSION 3.25)
file(READ ${SCHEMA} schema)

function(roff text result)
  string(REPLACE "\\" "\\e" text "${text}")
  string(REPLACE "-" "\\-" text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# describe(OUT DEPTH PATH...): the keys of the object at PATH and of the objects and lists in it.
function(describe out depth)
  set(text "")
  string(JSON count ERROR_VARIABLE missing LENGTH "${schema}" ${ARGN} properties)
  if(missing OR count EQUAL 0)
    set(${out} "" PARENT_SCOPE)
    return()
  endif()
  math(EXPR last "${count} - 1")
  foreach(i RANGE ${last})
    string(JSON key MEMBER "${schema}" ${ARGN} properties ${i})
    set(place ${ARGN} properties ${key})
    string(JSON meaning ERROR_VARIABLE none GET "${schema}" ${place} description)
    if(none)
      set(meaning "")
    endif()
    string(JSON words ERROR_VARIABLE none GET "${schema}" ${place} enum)
    if(NOT none)
      string(REGEX REPLACE "[\n ]+" " " words "${words}")
      string(APPEND meaning "; one of ${words}")
    endif()
    roff("${key}" key)
    roff("${meaning}" meaning)
    string(APPEND text ".TP\n.B ${key}\n${meaning}\n")
    if(depth LESS 4)
      math(EXPR deeper "${depth} + 1")
      describe(inner ${deeper} ${place})
      if(inner STREQUAL "")
        describe(inner ${deeper} ${place} items)
      endif()
      if(inner STREQUAL "")
        describe(inner ${deeper} ${place} additionalProperties)
      endif()
      if(NOT inner STREQUAL "")
        string(APPEND text ".RS\n${inner}.RE\n")
      endif()
    endif()
  endforeach()
  set(${out} "${text}" PARENT_SCOPE)
endfunction()

describe(keys 0)
file(WRITE ${OUTPUT} ".TH LOCKSTEP\\-PROJECT 5 \"\" \"lockstep ${VERSION}\" \"Lockstep\"
.SH NAME
lockstep\\-project \\- project file of lockstep
.SH DESCRIPTION
One file in JSON, in UTF\\-8, describes one controller: its clock, its technology objects, its tags, its programs of
function\\-block calls, its Modbus map and its traces.
.B lockstep check
tells every problem in it with its place;
.B lockstep describe
tells the blocks with their pins and the variables that config may set.
.SH KEYS
${keys}.SH FILES
.TP
.I /usr/share/lockstep/project.schema.json
the schema of the file, for editors and programs
.TP
.I /usr/share/lockstep/projects
examples
.SH SEE ALSO
.BR lockstep (1)
")
