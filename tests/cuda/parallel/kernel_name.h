#pragma once

// The names of kernels, for counts and times by kernel.

#include <cxxabi.h>

#include <cstdlib>
#include <memory>
#include <string>
#include <typeinfo>

namespace parallel_test {

/// Of the class template that a kernel of namespace fast is made from, without arguments.
inline std::string kernel_name(const std::type_info& kernel)
{
    int status = 0;
    const std::unique_ptr<char, void (*)(void*)> name(
        abi::__cxa_demangle(kernel.name(), nullptr, nullptr, &status), std::free);
    const std::string whole = name.get();
    const std::size_t begin = std::string("fast::").size();
    return whole.substr(begin, whole.find('<') - begin);
}

} // namespace parallel_test
