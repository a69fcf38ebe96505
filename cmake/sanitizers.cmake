# PLUMBLINE_SANITIZE: a list for -fsanitize=, for example "address,undefined" or "thread".
set(PLUMBLINE_SANITIZE "" CACHE STRING "Sanitizers to build with, separated by commas")
if(PLUMBLINE_SANITIZE)
    add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-fsanitize=${PLUMBLINE_SANITIZE}>
        $<$<COMPILE_LANGUAGE:CXX>:-fno-omit-frame-pointer> $<$<COMPILE_LANGUAGE:CXX>:-fno-sanitize-recover=all>)
    add_link_options(-fsanitize=${PLUMBLINE_SANITIZE})
    if(PLUMBLINE_SANITIZE MATCHES "address")
        add_compile_definitions(_GLIBCXX_ASSERTIONS)
    endif()
endif()
