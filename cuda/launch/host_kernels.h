#pragma once

// The kernels for the threads of the host. They are compiled once for every instruction set
// (instruction_set.h), in host_path.cpp, host_light.cpp, host_bdpt.cpp and host_surfaces.cpp.

#include "cuda/launch/instruction_set.h"
#include "cuda/launch/launch_samples.h"
#include "cuda/parallel/threaded_executor.h"

#include <optional>
#include <span>
#include <vector>

namespace fast {

/// Threads whose kernels are those of one instruction set.
struct HostThreads : ThreadedExecutor {
    using ThreadedExecutor::ThreadedExecutor;
    InstructionSet instructions = InstructionSet::baseline;
    std::vector<std::uint32_t> stage_words; // the queues of all threads
};

/// One for each thread: an atomic addition waits until the sum is there, while others can overlap. Not
/// if they take so much memory that to clear them and to add them up costs more than that.
inline std::uint32_t splat_copies(const HostThreads& threads, std::size_t bytes)
{
    constexpr std::size_t most_bytes = std::size_t{1} << 26;
    return threads.width() * bytes <= most_bytes ? threads.width() : 1;
}

// launch_samples on a HostThreads.
template <>
void launch_samples<Integrator::path>(HostThreads&, Needs, const SceneInMemory&, const SampleJob&);
template <>
void launch_samples<Integrator::bdpt>(HostThreads&, Needs, const SceneInMemory&, const SampleJob&);
template <>
void launch_samples<Integrator::light>(HostThreads&, Needs, const SceneInMemory&, const SampleJob&);

/// What a tree of surfaces is built from, and where it goes.
struct SurfaceJob {
    Memory& memory;
    std::span<const Triangle> triangles;
    std::span<const Sphere> spheres;
    TreeBuilder builder;
    std::optional<SurfaceTree>& result;
};

/// surface_tree on a HostThreads. The tree does not depend on the instructions: for `fastmath` it is
/// built with the best that round exactly.
SurfaceTree surface_tree(Memory& memory, HostThreads& executor, std::span<const Triangle> triangles,
                         std::span<const Sphere> spheres, TreeBuilder builder);

} // namespace fast

// The same, compiled for one instruction set. The names are those of cmake/instruction_sets.cmake.
#define PLUMBLINE_DECLARE_KERNELS(set)                                                                  \
    extern "C" {                                                                                        \
    void plumbline_kernels_##set##_path(fast::HostThreads&, fast::Needs, const fast::SceneInMemory&,    \
                                        const fast::SampleJob&);                                        \
    void plumbline_kernels_##set##_bdpt(fast::HostThreads&, fast::Needs, const fast::SceneInMemory&,    \
                                        const fast::SampleJob&);                                        \
    void plumbline_kernels_##set##_light(fast::HostThreads&, fast::Needs, const fast::SceneInMemory&,   \
                                         const fast::SampleJob&);                                       \
    void plumbline_kernels_##set##_surfaces(fast::HostThreads&, const fast::SurfaceJob&);               \
    }
PLUMBLINE_DECLARE_KERNELS(baseline)
PLUMBLINE_DECLARE_KERNELS(avx2)
PLUMBLINE_DECLARE_KERNELS(avx512)
PLUMBLINE_DECLARE_KERNELS(fastmath)
#undef PLUMBLINE_DECLARE_KERNELS

// Names the function of this file's instruction set.
#define PLUMBLINE_JOIN_KERNELS(set, integrator) plumbline_kernels_##set##_##integrator
#define PLUMBLINE_NAME_KERNELS(set, integrator) PLUMBLINE_JOIN_KERNELS(set, integrator)
#define PLUMBLINE_KERNELS_OF(integrator) PLUMBLINE_NAME_KERNELS(PLUMBLINE_KERNELS, integrator)
