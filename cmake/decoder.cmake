# pstrips_decoder: what shows a binary file while it arrives, without OpenSSL, tinyxml2, JSON, fmt and
# threads. zlib computes checksums; built with PSTRIPS_WITHOUT_ZLIB it needs no library at all.
set(PSTRIPS_DECODER_FOLDERS core vsplit weld filter decode pstrip_container pstrip_payload)
# What those folders have besides: files, threads, writing.
set(PSTRIPS_DECODER_LEAVES_OUT "/(file|equal_elements|binary_writer)\\.cpp")

function(pstrips_add_decoder)
  add_library(pstrips_decoder STATIC)
  add_library(pstrips::decoder ALIAS pstrips_decoder)
  set(kept "")
  foreach(folder IN LISTS PSTRIPS_DECODER_FOLDERS)
    set(target pstrips_${folder})
    get_target_property(sources ${target} SOURCES)
    get_target_property(directory ${target} SOURCE_DIR)
    list(TRANSFORM sources PREPEND ${directory}/)
    list(APPEND kept ${sources})
    target_sources(pstrips_decoder PRIVATE
      "$<FILTER:$<TARGET_OBJECTS:${target}>,EXCLUDE,${PSTRIPS_DECODER_LEAVES_OUT}>")
  endforeach()
  list(FILTER kept EXCLUDE REGEX ${PSTRIPS_DECODER_LEAVES_OUT})
  list(JOIN kept "\n" kept)
  file(WRITE ${PROJECT_BINARY_DIR}/decoder_sources.txt "${kept}\n")  # for other compilers
  target_link_libraries(pstrips_decoder PRIVATE ZLIB::ZLIB)
  pstrips_export(pstrips_decoder decoder)
endfunction()

# How users of a library find its headers: from the source tree or installed. They are C++20.
function(pstrips_export target name)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                              $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                              $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_include_directories(${target} SYSTEM PUBLIC $<BUILD_INTERFACE:${EXPECTED_INCLUDE_DIR}>)
endfunction()
