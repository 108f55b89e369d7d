# argand_precompile(target header...): compiles these headers once for the target, before its sources. The headers come
# from outside the tree and hardly ever change. Sources still include what they use, which tools/lint checks for
# the engine: clang-tidy reads them without precompiled headers. With ARGAND_PCH off the function does nothing.
function(argand_precompile target)
    if(NOT ARGAND_PCH)
        return()
    endif()
    list(TRANSFORM ARGN REPLACE "(.+)" "$<$<COMPILE_LANGUAGE:CXX>:\\1>")
    target_precompile_headers(${target} PRIVATE ${ARGN})
    argand_precompiled_for_ccache(${target})
endfunction()

# ccache reads the preprocessed source, which must say that a precompiled header was used.
function(argand_precompiled_for_ccache target)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>)
    elseif(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
        target_compile_options(${target} PRIVATE "$<$<COMPILE_LANGUAGE:CXX>:SHELL:-Xclang -fno-pch-timestamp>")
    endif()
endfunction()

# The standard headers that most sources include, and the libraries that the engine's own headers include.
set(ARGAND_STANDARD_HEADERS
    <algorithm> <array> <atomic> <bit> <charconv> <chrono> <cmath> <cstdint> <cstring> <filesystem> <fstream> <functional>
    <limits> <map> <memory> <numbers> <numeric> <optional> <set> <span> <sstream> <string> <string_view> <utility> <vector>
    <fmt/format.h>)
set(ARGAND_ENGINE_HEADERS ${ARGAND_STANDARD_HEADERS} <glm/glm.hpp> <nlohmann/json.hpp>)
