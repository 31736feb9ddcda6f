# How all code of the project is compiled. Floating point is never contracted or reordered, so that
# pictures are the same to the bit on every machine.
add_library(burin_flags INTERFACE)
target_include_directories(burin_flags INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(burin_flags INTERFACE
    -ffp-contract=off
    -fno-math-errno -fno-trapping-math  # nobody reads errno or floating-point exceptions; values stay the same
    -fno-semantic-interposition  # functions of one file may be inlined, though the code is position-independent
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wdouble-promotion
    -Wold-style-cast -Wnon-virtual-dtor -Wimplicit-fallthrough -Wundef)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(burin_flags INTERFACE -Wno-restrict)  # g++ 12 sees overlaps in every "text" + string (GCC bug 105651)
endif()
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(burin_flags INTERFACE -Wno-subobject-linkage)  # of private types in a source file that is included
endif()
if(BURIN_WERROR)
    target_compile_options(burin_flags INTERFACE -Werror)
endif()
if(BURIN_SANITIZE)
    add_compile_options(-fsanitize=${BURIN_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        # g++ 12 reports false uninitialised values inside library headers under sanitizers.
        add_compile_options(-Wno-maybe-uninitialized)
    endif()
    add_link_options(-fsanitize=${BURIN_SANITIZE})
endif()
if(BURIN_FUZZ)
    add_compile_options(-fsanitize=fuzzer-no-link)  # counts which code an input reaches
endif()
if(CMAKE_BUILD_TYPE STREQUAL "Debug")
    target_compile_definitions(burin_flags INTERFACE _GLIBCXX_ASSERTIONS)
endif()
