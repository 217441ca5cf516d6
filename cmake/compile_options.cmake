# Compiler settings shared by every target of this project; none reaches a project around it.

set(gelatin_warnings -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wold-style-cast
                     -Wcast-qual -Wformat=2 -Wundef)
if(GELATIN_WERROR)
    list(APPEND gelatin_warnings -Werror)
endif()
add_compile_options(${gelatin_warnings})
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # False alarms on std::string +, some of which precompiled headers bring out (GCC bugs 105329, 105651).
    add_compile_options(-Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
endif()

if(GELATIN_UNITY)
    # In sources that are compiled together: a name of one hides nothing of another. GCC takes them for headers, too.
    add_compile_options(-Wno-shadow)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        add_compile_options(-Wshadow=local -Wno-subobject-linkage)
    endif()
endif()

# No contraction behind our back: the same source gives the same bits whatever the compiler may fuse.
add_compile_options(-ffp-contract=off)

if(GELATIN_SANITIZE)
    # AddressSanitizer sees accesses beyond objects, and through null, when they happen; object-size and null, which look for
    # the same, and alignment, which casts alone could break, cost a fifth of what compiling takes.
    add_compile_options(-fsanitize=address,undefined -fno-sanitize=object-size,null,alignment
                        -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
    add_link_options(-fsanitize=address,undefined)
    # Lanes come from one source, so two instruction sets say as much of it as five: AVX2, and scalar code.
    add_compile_definitions("HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_SSE4|HWY_AVX3|HWY_AVX3_DL)")
else()
    # Each instruction set is compiled at each place that uses lanes. Processors of before 2008 take scalar code.
    add_compile_definitions(HWY_DISABLED_TARGETS=HWY_SSSE3)
endif()

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release)
endif()
