# Sanitized code takes three times as long to compile and to run. Files are what strangers write, so
# what reads or decodes them is sanitized; what works on a checked model runs beside it as released,
# but with its assertions.
set(PSTRIPS_NEVER_READ triangulate stripify simplify measure)
set(PSTRIPS_SANITIZED_TESTS
    "^(core|formats|validators|codecs/vsplit|codecs/filter)/|^converters/(any_input|compare|scene|stream)_test$")

function(pstrips_sanitize target)
  if(PSTRIPS_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=address,undefined -fno-sanitize-recover=all
                                             -fno-omit-frame-pointer
                                             # GCC takes the standard library's own members for
                                             # uninitialized once they are sanitized.
                                             -Wno-maybe-uninitialized)
  endif()
endfunction()

if(PSTRIPS_SANITIZE)
  add_link_options(-fsanitize=address,undefined)
endif()

if(PSTRIPS_LIBFUZZER)
  add_compile_options(-fsanitize=fuzzer-no-link)  # coverage of the library, too
endif()
