# argand_add_kernels(target [TWINS directory [PLAIN_TWINS name...] FILES] file.comp...) compiles each kernel at build time.
# NAME.comp becomes generated/kernels/NAME.hpp, included as "kernels/NAME.hpp", and NAME.cpp, which is compiled into the
# target.
#
# NAME_bindings.glsl becomes generated/kernels/NAME_bindings.hpp: the buffers that it declares as one struct, which the
# kernels that include it share.
#
# NAME.vert is a raster program together with NAME.frag beside it, and has no twin: where nothing rasterises, kernels fill
# the same buffers in other ways.
#
# With TWINS, other backends run the kernels too. FOLDER/NAME.comp then needs a body, shaders/shared/kernels/FOLDER/NAME.h,
# from which shader_compile writes the twin generated/kernels/NAME.cu and the header NAME.twin.h. A twin that needs more than
# the body is written by hand, as FOLDER/NAME.cu in the directory TWINS. FOLDER/NAME_texels.comp shares the twin of NAME.comp.
# The kernels of PLAIN_TWINS have a second twin, NAME.plain.cu, without the code that plain scenes do not need: twins know
# their specialization constants only when they run.
#
# Kernels in the folders parallel and device have a twin only if they have a body: for the others, the other backends use
# libraries.
#
# With ARGAND_KERNELS_FROM, the folder generated/kernels of another build of this tree, files are copied from there:
# optimising the largest kernels takes minutes.
#
# Sets the global property ARGAND_TWINS to the sources of all twins, and adds the target TARGET_twins, which writes the
# generated ones.
include(${CMAKE_CURRENT_LIST_DIR}/../../cmake/share_units.cmake)
function(argand_add_kernels target)
    cmake_parse_arguments(PARSE_ARGV 1 ARG "" TWINS "PLAIN_TWINS;FILES")
    set(directory ${CMAKE_BINARY_DIR}/generated/kernels)
    file(MAKE_DIRECTORY ${directory})
    foreach(file IN LISTS ARG_UNPARSED_ARGUMENTS ARG_FILES)
        get_filename_component(name ${file} NAME_WE)
        get_property(earlier GLOBAL PROPERTY ARGAND_KERNEL_${name})
        if(earlier)
            message(FATAL_ERROR "Two kernels are called ${name}: ${earlier} and ${file}; rename one of them")
        endif()
        set_property(GLOBAL PROPERTY ARGAND_KERNEL_${name} ${file})
        set(options)
        set(twin_files)
        set(outputs ${directory}/${name}.hpp)
        if(NOT name MATCHES "_bindings$")
            list(APPEND outputs ${directory}/${name}.cpp)
            list(APPEND bindings ${directory}/${name}.cpp)
        endif()
        get_filename_component(parent ${file} DIRECTORY)
        get_filename_component(folder ${parent} NAME)
        set(may_lack_twin FALSE)
        if(file MATCHES "[.]vert$")
            set(may_lack_twin TRUE)
        elseif(folder MATCHES "^(parallel|device)$" AND NOT EXISTS ${CMAKE_SOURCE_DIR}/shaders/shared/kernels/${folder}/${name}.h)
            set(may_lack_twin TRUE)
        endif()
        if(ARG_TWINS AND NOT may_lack_twin AND NOT name MATCHES "_bindings$")
            string(REGEX REPLACE "_texels$" "" twin ${name})
            set(options --twin ${twin})
            set(by_hand ${ARG_TWINS}/${folder}/${twin}.cu)
            if(NOT twin STREQUAL name)
                if(NOT EXISTS ${parent}/${twin}.comp)
                    message(FATAL_ERROR "Kernel ${file} shares the twin of ${twin}.comp, which does not exist")
                endif()
            elseif(EXISTS ${by_hand})
                list(APPEND twins ${by_hand})
                set(twin_files ${directory}/${name}.twin.h)
            else()
                list(APPEND options --write-twin)
                list(APPEND twins ${directory}/${name}.cu)
                set(twin_files ${directory}/${name}.twin.h ${directory}/${name}.cu)
                if(name IN_LIST ARG_PLAIN_TWINS)
                    list(REMOVE_ITEM ARG_PLAIN_TWINS ${name})
                    list(APPEND options --plain-twin)
                    list(APPEND twins ${directory}/${name}.plain.cu)
                    list(APPEND twin_files ${directory}/${name}.plain.cu)
                endif()
            endif()
        endif()
        if(ARGAND_KERNELS_FROM)
            set(files ${outputs} ${twin_files})
            list(TRANSFORM files REPLACE "^.*/" "${ARGAND_KERNELS_FROM}/")
            add_custom_command(
                OUTPUT ${outputs} ${twin_files}
                COMMAND ${CMAKE_COMMAND} -E copy_if_different ${files} ${directory}
                DEPENDS ${files}
                COMMENT "Copying kernel ${name}"
                VERBATIM)
        else()
            # The path as messages show it.
            file(RELATIVE_PATH shown ${CMAKE_SOURCE_DIR} ${file})
            add_custom_command(
                OUTPUT ${outputs} ${twin_files}
                COMMAND shader_compile -I shaders -I shaders/comp --out ${directory} --depfile ${directory}/${name}.d ${options} ${shown}
                DEPENDS ${file} shader_compile
                DEPFILE ${directory}/${name}.d
                WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}
                COMMENT "Compiling kernel ${shown}"
                VERBATIM)
        endif()
        target_sources(${target} PRIVATE ${outputs})
        list(APPEND generated ${directory}/${name}.hpp ${twin_files})
        list(APPEND all_twin_files ${twin_files})
    endforeach()
    target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${CMAKE_BINARY_DIR}/generated>)
    # Most of the time that one binding takes to compile goes to the headers.
    argand_share_units(${target} kernels 10 ${bindings})
    # All headers that are written from kernels, which tools/lint needs and nothing else builds by name.
    add_custom_target(${target}_generated DEPENDS ${generated})
    if(NOT TARGET argand_generated)
        add_custom_target(argand_generated)
    endif()
    add_dependencies(argand_generated ${target}_generated)
    if(ARG_PLAIN_TWINS)
        message(FATAL_ERROR "PLAIN_TWINS names ${ARG_PLAIN_TWINS}, for which no twin is written; take it off the list")
    endif()
    if(ARG_TWINS)
        file(GLOB_RECURSE written CONFIGURE_DEPENDS ${ARG_TWINS}/*.cu)
        list(REMOVE_ITEM written ${twins})
        if(written)
            message(FATAL_ERROR "No kernel has the twin ${written}; remove the file, or name it as the kernel")
        endif()
        add_custom_target(${target}_twins DEPENDS ${all_twin_files})
        set_property(GLOBAL PROPERTY ARGAND_TWINS ${twins})
    endif()
endfunction()
