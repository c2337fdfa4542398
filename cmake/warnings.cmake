# For our own targets only; third-party headers come in as SYSTEM.
function(pstrips_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wconversion)
endfunction()
