# The man page of the project file, from its schema: cmake -D SCHEMA=… -D VERSION=… -D OUTPUT=… -P project_man.cmake
cmake_minimum_required(VERSION 3.25)
file(READ ${SCHEMA} schema)

function(roff text result)
  string(REPLACE "\\" "\\e" text "${text}")
  string(REPLACE "-" "\\-" text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# follow(OUT PATH...): the path, or that of the definition to which it refers.
function(follow out)
  string(JSON name ERROR_VARIABLE none GET "${schema}" ${ARGN} $ref)
  if(none)
    set(${out} ${ARGN} PARENT_SCOPE)
  else()
    string(REPLACE "#/definitions/" "" name "${name}")
    set(${out} definitions ${name} PARENT_SCOPE)
  endif()
endfunction()

# describe_variants(OUT DEPTH PATH...): the keys of an object whose keys depend on one of them.
function(describe_variants out depth)
  set(text "")
  string(JSON count ERROR_VARIABLE missing LENGTH "${schema}" ${ARGN} allOf)
  if(NOT missing)
    math(EXPR last "${count} - 1")
    foreach(i RANGE ${last})
      set(condition ${ARGN} allOf ${i} if properties)
      string(JSON selector MEMBER "${schema}" ${condition} 0)
      string(JSON word GET "${schema}" ${condition} ${selector} enum 0)
      describe(inner ${depth} ${ARGN} allOf ${i} then)
      roff("${selector} ${word}" heading)
      string(APPEND text ".TP\n.B ${heading}\n.RS\n${inner}.RE\n")
    endforeach()
  endif()
  set(${out} "${text}" PARENT_SCOPE)
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
    string(JSON refers ERROR_VARIABLE none GET "${schema}" ${place} $ref)
    follow(place ${place})
    string(JSON meaning ERROR_VARIABLE none GET "${schema}" ${place} description)
    if(none)
      set(meaning "")
    endif()
    string(JSON words ERROR_VARIABLE none GET "${schema}" ${place} enum)
    if(NOT none)
      string(REGEX REPLACE "[\n ]+" " " words "${words}")
      string(APPEND meaning "; one of ${words}")
    endif()
    string(JSON otherwise ERROR_VARIABLE none GET "${schema}" ${place} default)
    if(NOT none)
      string(APPEND meaning "; ${otherwise} if not given")
    endif()
    roff("${key}" key)
    roff("${meaning}" meaning)
    string(APPEND text ".TP\n.B ${key}\n${meaning}\n")
    # What stands in several places is told once; of the variables of data blocks tells `lockstep describe`.
    get_property(told GLOBAL PROPERTY told)
    if(depth LESS 5 AND NOT refers MATCHES "/TO_" AND NOT "${refers}" IN_LIST told)
      set_property(GLOBAL APPEND PROPERTY told "${refers}")
      math(EXPR deeper "${depth} + 1")
      foreach(inside "" items additionalProperties)
        follow(values ${place} ${inside})
        describe(inner ${deeper} ${values})
        if(inner STREQUAL "")
          describe_variants(inner ${deeper} ${values})
        endif()
        if(NOT inner STREQUAL "")
          break()
        endif()
      endforeach()
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
