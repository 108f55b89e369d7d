# argand_share_units(target name size source...): compiles this many of the sources at a time as one unit, in which their
# headers are parsed, and their templates instantiated, only once.
function(argand_share_units target name size)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    set(count 0)
    foreach(source IN LISTS ARGN)
        math(EXPR group "${count} / ${size}")
        set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${name}_${group})
        math(EXPR count "${count} + 1")
    endforeach()
endfunction()
