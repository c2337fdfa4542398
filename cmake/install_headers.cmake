# Installs the public headers and those that they include, at install time. The latter go to
# pstrips/internal, so that their names meet nobody else's.
#   source    the source tree
#   includes  where headers are installed
cmake_minimum_required(VERSION 3.25)
set(destination "$ENV{DESTDIR}${includes}/pstrips")
file(GLOB public RELATIVE ${source}/include/pstrips ${source}/include/pstrips/*.h)

# Copies a header, its includes of ours renamed; adds those to `reached` of the caller.
function(install_header from to)
  file(READ ${from} text)
  string(REGEX MATCHALL "#include \"[a-z]+/[^\"]+\"" lines "${text}")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "#include \"(.*)\"" "\\1" header "${line}")
    if(NOT header MATCHES "^pstrips/")
      list(APPEND reached ${header})
    endif()
  endforeach()
  string(REGEX REPLACE "#include \"(core|codecs|formats|converters|validators)/"
                       "#include \"pstrips/internal/\\1/" text "${text}")
  message(STATUS "Installing: ${to}")
  file(WRITE ${to} "${text}")
  set(reached ${reached} PARENT_SCOPE)
endfunction()

set(reached "")
foreach(header IN LISTS public)
  install_header(${source}/include/pstrips/${header} ${destination}/${header})
endforeach()
set(installed "")
while(reached)
  list(POP_FRONT reached header)
  if(NOT header IN_LIST installed)
    list(APPEND installed ${header})
    install_header(${source}/${header} ${destination}/internal/${header})
  endif()
endwhile()
