// Your own tree builder on a GPU, under the same checks as own_builder.cpp. The kernels are yours: here,
// Morton codes and their order, one thread per primitive; the host then splits the sorted range in
// halves.

#include "check/trees/check_builder.h"
#include "check/trees/report.h"

#include <cuda_runtime.h>

#include <cstdint>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

void expect(cudaError_t error)
{
    if (error != cudaSuccess) throw std::runtime_error(cudaGetErrorString(error));
}

// An array in the GPU's memory.
template <class T>
struct Array {
    T* data = nullptr;
    explicit Array(std::size_t n) { expect(cudaMalloc(&data, n * sizeof(T))); }
    Array(const Array&) = delete;
    ~Array() { cudaFree(data); }
};

// ---- yours ----

// Every third bit of the result is a bit of x, which has ten.
__device__ std::uint32_t spread(std::uint32_t x)
{
    x = (x | x << 16) & 0x030000ff;
    x = (x | x << 8) & 0x0300f00f;
    x = (x | x << 4) & 0x030c30c3;
    return (x | x << 2) & 0x09249249;
}

// centres: x, y, z of each primitive, from 0 to 1.
__global__ void compute_codes(const float* centres, std::uint32_t* codes, int n)
{
    const int i = blockIdx.x * blockDim.x + threadIdx.x;
    if (i >= n) return;
    std::uint32_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const float cell = fminf(fmaxf(centres[3 * i + axis] * 1024.0f, 0.0f), 1023.0f);
        code = code << 1 | spread(static_cast<std::uint32_t>(cell));
    }
    codes[i] = code;
}

// The place of each primitive in the order of the codes: simple, and slow for many.
__global__ void compute_order(const std::uint32_t* codes, std::int64_t* order, int n)
{
    const int i = blockIdx.x * blockDim.x + threadIdx.x;
    if (i >= n) return;
    int smaller = 0;
    for (int j = 0; j < n; ++j) smaller += codes[j] < codes[i] || (codes[j] == codes[i] && j < i);
    order[smaller] = i;
}

std::int64_t halve(check::NeutralTree& tree, std::span<const ref::Aabb> boxes, std::int64_t begin,
                   std::int64_t end)
{
    const auto node = static_cast<std::int64_t>(tree.boxes.size());
    ref::Aabb box;
    for (std::int64_t i = begin; i < end; ++i) box = unite(box, boxes[tree.primitives[i]]);
    tree.boxes.push_back(box);
    tree.nodes.insert(tree.nodes.end(), {-1, -1, begin, end - begin});
    if (end - begin == 1) return node;
    const std::int64_t left = halve(tree, boxes, begin, (begin + end) / 2);
    const std::int64_t right = halve(tree, boxes, (begin + end) / 2, end);
    const std::int64_t inner[] = {left, right, 0, 0};
    std::copy(inner, inner + 4, tree.nodes.begin() + 4 * node);
    return node;
}

// ----------------

check::NeutralTree build(std::span<const ref::Aabb> boxes)
{
    check::NeutralTree tree;
    const int n = static_cast<int>(boxes.size());
    if (n == 0) return tree;
    ref::Aabb all;
    for (const ref::Aabb& box : boxes) {
        for (int a = 0; a < 3; ++a)
            if (!(box.lower[a] <= box.upper[a])) throw std::invalid_argument("a box is empty or NaN");
        all = unite(all, {centroid(box), centroid(box)});
    }
    std::vector<float> centres;
    for (const ref::Aabb& box : boxes)
        for (int a = 0; a < 3; ++a) {
            // Each is halved first, so that the difference cannot overflow.
            const double extent = 0.5 * all.upper[a] - 0.5 * all.lower[a];
            centres.push_back(static_cast<float>(
                extent > 0 ? (0.5 * centroid(box)[a] - 0.5 * all.lower[a]) / extent : 0));
        }
    Array<float> gpu_centres(centres.size());
    Array<std::uint32_t> gpu_codes(n);
    Array<std::int64_t> gpu_order(n);
    expect(cudaMemcpy(gpu_centres.data, centres.data(), centres.size() * sizeof(float),
                      cudaMemcpyHostToDevice));
    compute_codes<<<(n + 255) / 256, 256>>>(gpu_centres.data, gpu_codes.data, n);
    compute_order<<<(n + 255) / 256, 256>>>(gpu_codes.data, gpu_order.data, n);
    expect(cudaGetLastError());
    tree.primitives.resize(n);
    expect(cudaMemcpy(tree.primitives.data(), gpu_order.data, n * sizeof(std::int64_t),
                      cudaMemcpyDeviceToHost));
    halve(tree, boxes, 0, n);
    return tree;
}

int main()
{
    int devices = 0;
    if (const cudaError_t error = cudaGetDeviceCount(&devices); error != cudaSuccess || devices == 0) {
        std::cout << "SKIPPED: no GPU (" << cudaGetErrorString(error) << ")\n";
        return 77;
    }
    check::BuilderOptions options;
    options.largest = 10'000;
    const check::BuilderReport report = check::check_builder(build, options);
    std::cout << describe(report);
    return report.passes() ? 0 : 1;
}
