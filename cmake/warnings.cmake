# For our own targets only; third-party headers come in as SYSTEM.
function(pstrips_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wconversion)
endfunction()

if(PSTRIPS_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

if(PSTRIPS_LIBFUZZER)
  add_compile_options(-fsanitize=fuzzer-no-link)  # coverage of the library, too
endif()
