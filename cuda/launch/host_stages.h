#pragma once

// Runs the stages of an integrator on the threads of the host, for the instruction set that the
// including file is compiled for.

#include "cuda/launch/host_kernels.h"
#if defined(__AVX2__)
#include "cuda/stages/floats_film_add.h"
#include "cuda/stages/floats_rows.h"
#include "cuda/stages/floats_trace_rays.h"
#include "cuda/transport/floats_random.h"
#endif
#include "cuda/stages/stage_job.h"
#include "cuda/stages/trace_rays.h"

#include <algorithm>
#include <atomic>

namespace fast {

namespace {

#if defined(__AVX2__)
using StageExecutor = FloatsExecutor;
#else
using StageExecutor = SerialExecutor;
#endif

/// Over the threads: each takes one block of the samples after the other.
template <class Memory, class Trace>
struct TraceBlocks {
    std::uint32_t samples;          // of the launch
    std::uint32_t block;            // samples in a block, whose queues fit into the cache of a core
    std::span<std::uint32_t> words; // of all threads
    std::atomic<std::uint32_t>* next;
    Trace trace;

    void operator()(std::uint32_t thread) const
    {
        const std::size_t each = Memory::words_for(block);
        Memory memory(words.subspan(thread * each, each), block);
        for (;;) {
            const std::uint64_t first =
                std::uint64_t{next->fetch_add(1, std::memory_order_relaxed)} * block;
            if (first >= samples) return;
            const auto from = static_cast<std::uint32_t>(first);
            trace(memory, thread, from, std::min(block, samples - from));
        }
    }
};

/// Calls trace(memory, thread, first sample, samples) for blocks of at most `block` samples.
template <class Memory, class Trace>
void trace_blocks(HostThreads& threads, std::uint32_t samples, std::uint32_t block, const Trace& trace)
{
    threads.stage_words.resize(
        std::max(threads.stage_words.size(), threads.width() * Memory::words_for(block)));
    std::atomic<std::uint32_t> next = 0;
    threads(threads.width(),
            TraceBlocks<Memory, Trace>{samples, block, threads.stage_words, &next, trace});
}

} // namespace

} // namespace fast
