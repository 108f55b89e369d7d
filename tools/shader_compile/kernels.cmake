# argand_add_kernels(target [TWINS directory] file.comp...): compiles each kernel at build time. NAME.comp becomes
# generated/kernels/NAME.hpp, included as "kernels/NAME.hpp", and NAME.cpp, which becomes part of the target. With TWINS,
# FOLDER/NAME.comp and FOLDER/NAME_texels.comp must have a twin FOLDER/NAME.cu in that directory, for which NAME.twin.h is
# written; but those in the folders parallel and device, which only Vulkan needs: other backends have libraries for them.
function(argand_add_kernels target)
    cmake_parse_arguments(PARSE_ARGV 1 ARG "" TWINS "")
    set(directory ${CMAKE_BINARY_DIR}/generated/kernels)
    file(MAKE_DIRECTORY ${directory})
    foreach(file IN LISTS ARG_UNPARSED_ARGUMENTS)
        get_filename_component(name ${file} NAME_WE)
        get_property(earlier GLOBAL PROPERTY ARGAND_KERNEL_${name})
        if(earlier)
            message(FATAL_ERROR "Two kernels are called ${name}: ${earlier} and ${file}; rename one of them")
        endif()
        set_property(GLOBAL PROPERTY ARGAND_KERNEL_${name} ${file})
        set(twin)
        set(twin_header)
        get_filename_component(folder ${file} DIRECTORY)
        get_filename_component(folder ${folder} NAME)
        if(ARG_TWINS AND NOT folder MATCHES "^(parallel|device)$")
            string(REGEX REPLACE "_texels$" "" twin_name ${name})
            set(twin_source ${ARG_TWINS}/${folder}/${twin_name}.cu)
            if(NOT EXISTS ${twin_source})
                message(FATAL_ERROR "Kernel ${file} has no twin; write ${twin_source}")
            endif()
            set(twin --twin ${twin_name})
            if(twin_name STREQUAL name)
                set(twin_header ${directory}/${name}.twin.h)
            endif()
        endif()
        # The path as messages show it.
        file(RELATIVE_PATH shown ${CMAKE_SOURCE_DIR} ${file})
        add_custom_command(
            OUTPUT ${directory}/${name}.hpp ${directory}/${name}.cpp ${twin_header}
            COMMAND shader_compile -I shaders -I shaders/comp --out ${directory} --depfile ${directory}/${name}.d ${twin} ${shown}
            DEPENDS ${file} shader_compile
            DEPFILE ${directory}/${name}.d
            WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}
            COMMENT "Compiling kernel ${shown}"
            VERBATIM)
        target_sources(${target} PRIVATE ${directory}/${name}.cpp ${directory}/${name}.hpp ${twin_header})
        list(APPEND bindings ${directory}/${name}.cpp)
        list(APPEND generated ${directory}/${name}.hpp ${twin_header})
        list(APPEND twin_headers ${twin_header})
    endforeach()
    target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${CMAKE_BINARY_DIR}/generated>)
    # Most of the time that one binding takes to compile goes to the headers, so ten of them share a translation unit.
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    set(count 0)
    foreach(binding IN LISTS bindings)
        math(EXPR group "${count} / 10")
        set_source_files_properties(${binding} PROPERTIES UNITY_GROUP kernels_${group})
        math(EXPR count "${count} + 1")
    endforeach()
    # All headers that are written from kernels, which tools/lint needs and nothing else builds by name.
    add_custom_target(${target}_generated DEPENDS ${generated})
    if(NOT TARGET argand_generated)
        add_custom_target(argand_generated)
    endif()
    add_dependencies(argand_generated ${target}_generated)
    if(ARG_TWINS)
        # What the twins, which are targets of their own, wait for.
        add_custom_target(${target}_twin_headers DEPENDS ${twin_headers})
    endif()
endfunction()
