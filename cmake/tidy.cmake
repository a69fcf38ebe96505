# plumbline_tidy(TARGET [BATCH]): makes one file that includes all sources of a target of this folder, or one file for
# each BATCH of them, and libraries of these files that are never built: they give clang-tidy a command line. The test
# lint.tidy.NAME checks the file NAME.cpp (tests/lint/CMakeLists.txt). So names in anonymous namespaces must be unique
# in a folder, and the check is three times as fast.
function(plumbline_tidy target)
    get_target_property(sources ${target} SOURCES)
    list(FILTER sources INCLUDE REGEX "\\.cpp$")
    set(name ${target})
    set(number 0)
    while(sources) # none in a target of device code alone
        set(batch ${sources})
        if(ARGC GREATER 1)
            list(SUBLIST sources 0 ${ARGV1} batch)
            math(EXPR number "${number} + 1")
            set(name ${target}_${number})
        endif()
        list(REMOVE_ITEM sources ${batch})
        plumbline_tidy_file(${name} ${target} ${batch})
    endwhile()
endfunction()

function(plumbline_tidy_file name target)
    list(TRANSFORM ARGN REPLACE "(.+)" "#include \"${CMAKE_CURRENT_SOURCE_DIR}/\\1\"\n" OUTPUT_VARIABLE lines)
    string(JOIN "" content ${lines})
    set(file ${PROJECT_BINARY_DIR}/tidy/${name}.cpp)
    file(CONFIGURE OUTPUT ${file} CONTENT "${content}" @ONLY)
    add_library(tidy_${name} OBJECT EXCLUDE_FROM_ALL ${file})
    foreach(property IN ITEMS LINK_LIBRARIES COMPILE_DEFINITIONS COMPILE_OPTIONS INCLUDE_DIRECTORIES)
        get_target_property(value ${target} ${property})
        if(value)
            list(FILTER value EXCLUDE REGEX "^(--param=|-fno-gnu-unique)") # of GCC's own; clang would warn of them
            set_target_properties(tidy_${name} PROPERTIES ${property} "${value}")
        endif()
    endforeach()
    set_property(GLOBAL APPEND PROPERTY PLUMBLINE_TIDY_FILES ${name})
endfunction()
