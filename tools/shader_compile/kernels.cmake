# argand_add_kernels(target file.comp...): compiles each kernel at build time. NAME.comp becomes
# generated/kernels/NAME.hpp, included as "kernels/NAME.hpp", and NAME.cpp, which becomes part of the target.
function(argand_add_kernels target)
    set(directory ${CMAKE_BINARY_DIR}/generated/kernels)
    file(MAKE_DIRECTORY ${directory})
    foreach(file IN LISTS ARGN)
        get_filename_component(name ${file} NAME_WE)
        get_property(earlier GLOBAL PROPERTY ARGAND_KERNEL_${name})
        if(earlier)
            message(FATAL_ERROR "Two kernels are called ${name}: ${earlier} and ${file}; rename one of them")
        endif()
        set_property(GLOBAL PROPERTY ARGAND_KERNEL_${name} ${file})
        # The path as messages show it.
        file(RELATIVE_PATH shown ${CMAKE_SOURCE_DIR} ${file})
        add_custom_command(
            OUTPUT ${directory}/${name}.hpp ${directory}/${name}.cpp
            COMMAND shader_compile -I shaders -I shaders/comp --out ${directory} --depfile ${directory}/${name}.d ${shown}
            DEPENDS ${file} shader_compile
            DEPFILE ${directory}/${name}.d
            WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}
            COMMENT "Compiling kernel ${shown}"
            VERBATIM)
        target_sources(${target} PRIVATE ${directory}/${name}.cpp ${directory}/${name}.hpp)
    endforeach()
    target_include_directories(${target} PUBLIC ${CMAKE_BINARY_DIR}/generated)
endfunction()
