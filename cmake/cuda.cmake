# PLUMBLINE_CUDA: AUTO uses nvcc if it is found, ON requires it, OFF builds without it.
# Sets PLUMBLINE_WITH_CUDA. Included by the top folder: a language is enabled for a folder and the folders
# below it, and programs outside cuda/ link device code.
#
# PLUMBLINE_CUDA_QUICK: device code with hardly any optimisation, slow on a GPU and compiled in half the time. For runs of
# the tests on machines without a GPU, where device code is compiled and linked and never executed.
option(PLUMBLINE_CUDA_QUICK "Compile the device code quickly and without most optimisations" OFF)
set(PLUMBLINE_WITH_CUDA OFF)
if(NOT PLUMBLINE_CUDA STREQUAL "OFF")
    include(CheckLanguage)
    check_language(CUDA)
    if(CMAKE_CUDA_COMPILER)
        set(PLUMBLINE_WITH_CUDA ON)
    elseif(PLUMBLINE_CUDA STREQUAL "ON")
        message(FATAL_ERROR "PLUMBLINE_CUDA is ON but no nvcc was found: add its folder to PATH or set CUDACXX.")
    endif()
endif()

if(PLUMBLINE_WITH_CUDA)
    # "90" without a suffix: machine code for Hopper, and PTX for later GPUs.
    set(CMAKE_CUDA_ARCHITECTURES 90)
    set(CMAKE_CUDA_RUNTIME_LIBRARY Static)
    enable_language(CUDA)
    # CMake 3.25 does not support C++20 for CUDA: without these options it passes no flag, with no warning.
    set(CMAKE_CUDA20_STANDARD_COMPILE_OPTION -std=c++20)
    set(CMAKE_CUDA20_EXTENSION_COMPILE_OPTION -std=c++20)
    set(CMAKE_CUDA_STANDARD 20)
    set(CMAKE_CUDA_STANDARD_REQUIRED ON)
    set(CMAKE_CUDA_EXTENSIONS OFF)
    if(PLUMBLINE_WARNINGS_AS_ERRORS)
        target_compile_options(plumbline_warnings INTERFACE
            "$<$<COMPILE_LANGUAGE:CUDA>:SHELL:-Werror all-warnings -Xcompiler=-Wall,-Wextra,-Werror>")
    endif()
    set(optimised "")
    if(PLUMBLINE_CUDA_QUICK)
        set(optimised ", compiled quickly: slow on a GPU")
    endif()
    message(STATUS "Device code: nvcc ${CMAKE_CUDA_COMPILER_VERSION} (${CMAKE_CUDA_COMPILER}), sm_90 and PTX${optimised}")
else()
    message(STATUS "Device code: none (PLUMBLINE_CUDA is ${PLUMBLINE_CUDA}, nvcc ${CMAKE_CUDA_COMPILER}); everything else is built")
endif()
