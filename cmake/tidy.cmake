# plumbline_tidy(TARGET): makes one file that includes all sources of a target of this folder, and a library
# of this file that is never built: it gives clang-tidy a command line (tests/lint/tidy.sh checks these files).
# So names in anonymous namespaces must be unique in a folder, and the check is three times as fast.
function(plumbline_tidy target)
    get_target_property(sources ${target} SOURCES)
    set(content "")
    foreach(source IN LISTS sources)
        if(source MATCHES "\\.cpp$")
            string(APPEND content "#include \"${CMAKE_CURRENT_SOURCE_DIR}/${source}\"\n")
        endif()
    endforeach()
    if(NOT content)
        return() # device code alone
    endif()
    set(file ${PROJECT_BINARY_DIR}/tidy/${target}.cpp)
    file(CONFIGURE OUTPUT ${file} CONTENT "${content}" @ONLY)
    add_library(tidy_${target} OBJECT EXCLUDE_FROM_ALL ${file})
    foreach(property IN ITEMS LINK_LIBRARIES COMPILE_DEFINITIONS INCLUDE_DIRECTORIES)
        get_target_property(value ${target} ${property})
        if(value)
            set_target_properties(tidy_${target} PROPERTIES ${property} "${value}")
        endif()
    endforeach()
endfunction()
