# The instruction sets of the host's kernels (cuda/launch/instruction_set.h) besides the compiler's default. The library
# Highway counts AES and CLMUL to AVX2. With sanitizers only the default is built: it has all that they look for.
set(PLUMBLINE_AVX2_FLAGS -march=x86-64-v3 -maes -mpclmul)
set(PLUMBLINE_AVX512_FLAGS -march=x86-64-v4 -maes -mpclmul)
set(PLUMBLINE_INSTRUCTION_SETS OFF)
option(PLUMBLINE_QUICK_KERNELS "Compile the host's kernels for the default instruction set alone, in a third of the time: they are slower" OFF)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64" AND NOT PLUMBLINE_SANITIZE AND NOT PLUMBLINE_QUICK_KERNELS)
    set(PLUMBLINE_INSTRUCTION_SETS ON)
    include(CheckCXXSourceRuns)
    set(CMAKE_REQUIRED_FLAGS "-march=x86-64-v3 -maes -mpclmul")
    check_cxx_source_runs("int main() { return __builtin_cpu_supports(\"avx2\") && __builtin_cpu_supports(\"fma\") ? 0 : 1; }" PLUMBLINE_RUNS_AVX2)
    unset(CMAKE_REQUIRED_FLAGS)
endif()

# How the kernels are compiled, whatever the instruction set.
# -fno-math-errno, -fno-trapping-math: square roots and selections are single instructions. -O3 and the limits: a stage
# and all that it calls become one function, in which registers are not stored and loaded around calls
# (docs/stages.md, section 7). -fno-tree-vectorize: the code names the vectors that it wants. No bit depends on these.
set(PLUMBLINE_KERNEL_FLAGS -fno-math-errno -fno-trapping-math -O3 -fno-tree-vectorize)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND PLUMBLINE_KERNEL_FLAGS --param=max-inline-insns-single=1000 --param=inline-unit-growth=200
        --param=large-function-growth=1000 --param=large-function-insns=20000)
endif()

if(PLUMBLINE_QUICK_KERNELS) # no bit depends on this either
    set(PLUMBLINE_KERNEL_FLAGS -fno-math-errno -fno-trapping-math -O1)
endif()

# `fastmath` (cuda/launch/instruction_set.h): the kernels once more, with rounding left to the compiler, for the best
# instruction set that this machine runs. NaN and infinity are kept, because they are data: absent triangles and boxes.
if(PLUMBLINE_FAST_MATH_KERNELS)
    set(PLUMBLINE_FAST_MATH_FLAGS ${PLUMBLINE_KERNEL_FLAGS} -ffast-math -fno-finite-math-only -ffp-contract=fast)
    set(PLUMBLINE_FAST_MATH_SET baseline)
    if(PLUMBLINE_RUNS_AVX2)
        check_cxx_source_runs("int main() { return __builtin_cpu_supports(\"avx512bw\") && __builtin_cpu_supports(\"avx512dq\") && __builtin_cpu_supports(\"avx512vl\") ? 0 : 1; }" PLUMBLINE_RUNS_AVX512)
        set(PLUMBLINE_FAST_MATH_SET avx2)
        if(PLUMBLINE_RUNS_AVX512)
            set(PLUMBLINE_FAST_MATH_SET avx512)
        endif()
        string(TOUPPER ${PLUMBLINE_FAST_MATH_SET} set)
        list(APPEND PLUMBLINE_FAST_MATH_FLAGS ${PLUMBLINE_${set}_FLAGS})
    endif()
endif()

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
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        # Else inline variables are "unique" symbols, which objcopy does not make local: two definitions when linked.
        target_compile_options(${objects} PRIVATE -fno-gnu-unique)
    endif()
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
