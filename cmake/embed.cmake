# plumbline_embed(HEADER NAMESPACE NAME=FILE...): makes the header build/generated/HEADER with the text of each file as a
# std::string_view NAME in the namespace. It is made when CMake configures, which it does again when a file has changed.
# The files are text without the characters )embedded".
function(plumbline_embed header namespace)
    set(content "#pragma once\n#include <string_view>\nnamespace ${namespace} {\n")
    foreach(entry IN LISTS ARGN)
        string(REGEX MATCH "^([^=]+)=(.+)$" entry "${entry}")
        set(name ${CMAKE_MATCH_1})
        get_filename_component(file ${CMAKE_MATCH_2} ABSOLUTE)
        file(READ ${file} text)
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
        # An array has a size: the length of a literal would be counted at compile time, character by character.
        string(APPEND content "inline constexpr char ${name}_text[] = R\"embedded(${text})embedded\";\n"
            "inline constexpr std::string_view ${name}(${name}_text, sizeof ${name}_text - 1);\n")
    endforeach()
    string(APPEND content "}\n")
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/${header} @ONLY CONTENT "@content@") # written if it changes
endfunction()
