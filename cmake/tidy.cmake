# plumbline_tidy(GROUP TARGET...): adds all sources of targets of this folder to one file of sources of several folders,
# tidy/GROUP.cpp, and makes an object library of that file that is never built: it gives clang-tidy a command line. The
# test lint.tidy.GROUP checks the file (tests/lint/CMakeLists.txt). Most of the time goes to headers of the system, which
# each file of a group would include again. So names in anonymous namespaces must be unique in a namespace, and names
# outside of namespaces in a group.
function(plumbline_tidy group)
    set(file ${PROJECT_BINARY_DIR}/tidy/${group}.cpp)
    get_property(groups GLOBAL PROPERTY PLUMBLINE_TIDY_GROUPS)
    if(NOT group IN_LIST groups)
        set_property(GLOBAL APPEND PROPERTY PLUMBLINE_TIDY_GROUPS ${group})
        add_library(tidy_${group} OBJECT EXCLUDE_FROM_ALL ${file})
    endif()
    foreach(target IN LISTS ARGN)
        get_target_property(sources ${target} SOURCES)
        list(FILTER sources INCLUDE REGEX "\\.cpp$") # none of device code
        list(TRANSFORM sources REPLACE "(.+)" "#include \"${CMAKE_CURRENT_SOURCE_DIR}/\\1\"\n")
        set_property(GLOBAL APPEND_STRING PROPERTY PLUMBLINE_TIDY_${group} "${sources}")
        # What the target's own sources are compiled with, the folders of its libraries' headers included. Options of GCC's
        # own would be warned of. Without -Werror, .clang-tidy chooses the files in which a warning is an error: not headers
        # of libraries.
        target_include_directories(tidy_${group} PRIVATE $<TARGET_PROPERTY:${target},INCLUDE_DIRECTORIES>)
        target_compile_definitions(tidy_${group} PRIVATE $<TARGET_PROPERTY:${target},COMPILE_DEFINITIONS>)
        target_compile_options(tidy_${group} PRIVATE
            "$<FILTER:$<TARGET_PROPERTY:${target},COMPILE_OPTIONS>,EXCLUDE,^(--param=|-fno-gnu-unique|-Werror)>")
    endforeach()
    get_property(lines GLOBAL PROPERTY PLUMBLINE_TIDY_${group})
    string(REPLACE ";" "" lines "${lines}")
    file(CONFIGURE OUTPUT ${file} CONTENT "${lines}" @ONLY)
endfunction()
