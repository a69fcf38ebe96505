#include "tests/bench/embree.h"

#include <embree3/rtcore.h>

#include <limits>
#include <string>

namespace bench {

namespace {

/// A device, and a scene with one triangle mesh, not yet built.
class Embree {
public:
    Embree(const scenes::Scene& scene, EmbreeOptions options)
        : device_(rtcNewDevice(("set_affinity=0,threads=" + std::to_string(options.threads)).c_str())),
          quality_(options.medium ? RTC_BUILD_QUALITY_MEDIUM : RTC_BUILD_QUALITY_LOW),
          flags_(options.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE)
    {
        for (const scenes::Triangle& triangle : scene.triangles)
            for (const ref::Vec3& vertex : triangle.vertices) {
                indices_.push_back(static_cast<unsigned>(indices_.size()));
                for (int axis = 0; axis < 3; ++axis)
                    vertices_.push_back(static_cast<float>(vertex[axis]));
            }
        vertices_.push_back(0); // Embree reads 16 bytes at the last vertex
        triangles_ = scene.triangles.size();
    }
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;
    ~Embree()
    {
        clear();
        rtcReleaseDevice(device_);
    }
    void prepare()
    {
        clear();
        scene_ = rtcNewScene(device_);
        rtcSetSceneBuildQuality(scene_, quality_);
        rtcSetSceneFlags(scene_, flags_);
        RTCGeometry mesh = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetGeometryBuildQuality(mesh, quality_);
        rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices_.data(),
                                   0, 3 * sizeof(float), 3 * triangles_);
        rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices_.data(), 0,
                                   3 * sizeof(unsigned), triangles_);
        rtcCommitGeometry(mesh);
        rtcAttachGeometry(scene_, mesh);
        rtcReleaseGeometry(mesh);
    }
    void build() { rtcCommitScene(scene_); }
    [[nodiscard]] float closest(const ref::Ray& ray) const
    {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit query{};
        query.ray = {static_cast<float>(ray.origin.x),
                     static_cast<float>(ray.origin.y),
                     static_cast<float>(ray.origin.z),
                     0,
                     static_cast<float>(ray.direction.x),
                     static_cast<float>(ray.direction.y),
                     static_cast<float>(ray.direction.z),
                     0,
                     std::numeric_limits<float>::infinity(),
                     ~0u,
                     0,
                     0};
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene_, &context, &query);
        return query.ray.tfar;
    }

private:
    void clear()
    {
        if (scene_ != nullptr) rtcReleaseScene(scene_);
        scene_ = nullptr;
    }
    RTCDevice device_;
    RTCBuildQuality quality_;
    RTCSceneFlags flags_;
    RTCScene scene_ = nullptr;
    std::vector<float> vertices_;
    std::vector<unsigned> indices_;
    std::size_t triangles_ = 0;
};

} // namespace

void embree_build(benchmark::State& state, const scenes::Scene& scene, EmbreeOptions options)
{
    Embree embree(scene, options);
    for (auto _ : state) {
        state.PauseTiming();
        embree.prepare();
        state.ResumeTiming();
        embree.build();
    }
    state.counters["primitives"] = static_cast<double>(scene.triangles.size());
}

void embree_trace(benchmark::State& state, const scenes::Scene& scene, const std::vector<ref::Ray>& rays,
                  EmbreeOptions options)
{
    Embree embree(scene, options);
    embree.prepare();
    embree.build();
    for (auto _ : state)
        for (const ref::Ray& ray : rays) benchmark::DoNotOptimize(embree.closest(ray));
    const auto traced = static_cast<double>(state.iterations()) * static_cast<double>(rays.size());
    state.counters["rays"] = benchmark::Counter(traced, benchmark::Counter::kIsRate);
}

} // namespace bench
