// Times of the kernels of a build on one thread: the tree by clustering and its wide tree (cuda/trees/).
//
//   build_kernels [TRIANGLES [ROUNDS]]
//
// Prints a Markdown table: of each kernel the least time of all rounds, in ms, as the sum over its
// launches in a build. The first build is not counted: it touches the memory of the binary tree. The
// wide tree is made in new memory each time.

#include "cuda/trees/hploc.h"
#include "cuda/trees/scene_geometry.h"
#include "cuda/trees/wide_tree.h"
#include "tests/bench/bumpy_sphere.h"

#include <cxxabi.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <limits>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

namespace {

/// Runs the indices in order, and adds up the time of each kernel.
class TimedExecutor {
public:
    template <fast::Kernel K>
    void operator()(std::uint32_t count, const K& kernel)
    {
        const auto start = std::chrono::steady_clock::now();
        serial_(count, kernel);
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
        kernel_named(typeid(K).name()).now += taken.count();
    }
    [[nodiscard]] static std::uint32_t width() { return 1; }

    /// After the build that touches the memory.
    void forget() { kernels_.clear(); }
    void end_round()
    {
        for (Kernel& kernel : kernels_) {
            kernel.least = std::min(kernel.least, kernel.now);
            kernel.now = 0;
        }
    }
    void print(std::ostream& out) const
    {
        out << "| kernel | ms |\n|---|---|\n" << std::fixed << std::setprecision(2);
        double sum = 0;
        for (const Kernel& kernel : kernels_) {
            out << "| `" << short_name(kernel.name) << "` | " << kernel.least << " |\n";
            sum += kernel.least;
        }
        out << "| sum | " << sum << " |\n";
    }

private:
    struct Kernel {
        std::string_view name; // as the compiler writes it
        double now = 0;
        double least = std::numeric_limits<double>::infinity();
    };

    Kernel& kernel_named(std::string_view name)
    {
        const auto found = std::ranges::find(kernels_, name, &Kernel::name);
        return found != kernels_.end() ? *found : kernels_.emplace_back(Kernel{name});
    }
    /// Without the namespace, and without template arguments after the first.
    static std::string short_name(std::string_view mangled)
    {
        int status = 0;
        char* const readable =
            abi::__cxa_demangle(std::string(mangled).c_str(), nullptr, nullptr, &status);
        std::string name = status == 0 ? readable : std::string(mangled);
        std::free(readable); // NOLINT(cppcoreguidelines-no-malloc,cppcoreguidelines-owning-memory)
        if (name.starts_with("fast::")) name.erase(0, 6);
        const auto comma = name.find(',');
        return comma == std::string::npos ? name : name.substr(0, comma) + ">";
    }

    fast::SerialExecutor serial_;
    std::vector<Kernel> kernels_;
};

} // namespace

int main(int argc, char** argv)
{
    const double triangles = argc > 1 ? std::atof(argv[1]) : 1e5;
    const int rounds = argc > 2 ? std::atoi(argv[2]) : 20;
    if (!(triangles >= 8 && triangles <= 1e8) || rounds < 1) {
        std::cerr << "build_kernels [TRIANGLES [ROUNDS]]: 8 to 1e8 triangles, at least one round\n";
        return 2;
    }
    const scenes::Scene scene = bench::bumpy_sphere("sphere", triangles);
    const auto count = static_cast<std::uint32_t>(scene.triangles.size());
    fast::HostMemory memory;
    const fast::Buffer<fast::Triangle> given(memory, fast::triangles_of(scene));
    const fast::Buffer<fast::Aabb> boxes(memory, fast::boxes_of(scene));
    TimedExecutor executor;
    fast::MortonOrder<std::uint64_t> order(memory, executor, count);
    fast::Hploc tree(memory, count);
    for (int round = 0; round <= rounds; ++round) {
        order.build(executor, boxes.all());
        tree.build(executor, boxes.all(), order);
        const fast::WideTree wide(memory, executor, tree.nodes(), tree.divisions(), order.primitives(),
                                  given.all());
        if (round == 0)
            executor.forget();
        else
            executor.end_round();
    }
    executor.print(std::cout);
    return 0;
}
