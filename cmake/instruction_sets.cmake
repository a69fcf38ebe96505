# plumbline_kernels(TARGET SET FLAGS SOURCES...): compiles the sources with FLAGS and PLUMBLINE_KERNELS=SET, and adds
# them to TARGET as one object file of which only the functions plumbline_kernels_SET_... are visible to others.
#
# The last step is necessary. Inline functions and templates that are not inlined are emitted by every file that uses
# them, and the linker keeps one copy, whichever comes first: a copy with AVX-512 instructions might be called on a
# processor that does not have them. As local symbols the copies stay apart.
function(plumbline_kernels target set flags)
    set(objects ${target}_${set})
    add_library(${objects} OBJECT ${ARGN})
    target_compile_options(${objects} PRIVATE ${flags})
    target_compile_definitions(${objects} PRIVATE PLUMBLINE_KERNELS=${set})
    target_include_directories(${objects} PRIVATE ${PROJECT_SOURCE_DIR})
    foreach(property IN ITEMS LINK_LIBRARIES)
        target_link_libraries(${objects} PRIVATE $<TARGET_PROPERTY:${target},${property}>)
    endforeach()
    set(merged ${CMAKE_CURRENT_BINARY_DIR}/${objects}.o)
    add_custom_command(OUTPUT ${merged}
        COMMAND ${CMAKE_LINKER} -r --force-group-allocation -o ${merged}.all $<TARGET_OBJECTS:${objects}>
        COMMAND ${CMAKE_OBJCOPY} --wildcard --keep-global-symbol=plumbline_kernels_${set}_* ${merged}.all ${merged}
        DEPENDS ${objects} $<TARGET_OBJECTS:${objects}> COMMAND_EXPAND_LISTS VERBATIM)
    target_sources(${target} PRIVATE ${merged})
    set_source_files_properties(${merged} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
endfunction()
