// Scenes for Mitsuba 3, read back by the meaning that Mitsuba's documentation gives to its elements.

#include "scenes/export/exact.h"
#include "scenes/export/mitsuba.h"
#include "tests/scenes/exported.h"

#include <rapidcheck/gtest.h>
#include <tinyxml2.h>

#include <cstring>

namespace {

using namespace scenes_test;
using scenes::exports::Exported;
using scenes::exports::Options;

class MitsubaFile {
public:
    explicit MitsubaFile(const Scene& scene, const Options& options = {})
        : exported(scenes::exports::to_mitsuba(scene, options, "a.xml"))
    {
        if (xml_.Parse(exported.files.back().bytes.c_str()) != tinyxml2::XML_SUCCESS)
            throw std::runtime_error(xml_.ErrorStr());
    }

    /// The `number`-th element of this kind and type below the root.
    [[nodiscard]] const tinyxml2::XMLElement& element(const char* kind, const char* type,
                                                      int number = 0) const
    {
        const auto* element = xml_.RootElement()->FirstChildElement(kind);
        for (; element != nullptr; element = element->NextSiblingElement(kind))
            if (element->Attribute("type", type) && number-- == 0) return *element;
        throw std::runtime_error(std::string("no ") + kind + " " + type);
    }

    Exported exported;

private:
    tinyxml2::XMLDocument xml_;
};

/// The value of the child called `name`.
std::string value_of(const tinyxml2::XMLElement& element, const char* name)
{
    for (const auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement())
        if (child->Attribute("name", name)) return child->Attribute("value");
    throw std::runtime_error(std::string("no ") + name);
}

/// Of the element's to_world: rows of four numbers.
std::vector<double> mitsuba_matrix(const tinyxml2::XMLElement& element)
{
    return numbers_in(
        element.FirstChildElement("transform")->FirstChildElement("matrix")->Attribute("value"));
}

Vec3 transformed(const std::vector<double>& m, const Vec3& v, double w)
{
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z + m[3] * w,
            m[4] * v.x + m[5] * v.y + m[6] * v.z + m[7] * w,
            m[8] * v.x + m[9] * v.y + m[10] * v.z + m[11] * w};
}

/// The triangles in a binary PLY file of doubles.
std::vector<Corners> triangles_in_ply(const std::string& bytes)
{
    const std::string end = "end_header\n";
    const char* at = bytes.data() + bytes.find(end) + end.size();
    const auto count = [&](const std::string& element) {
        return std::stoul(bytes.substr(bytes.find("element " + element + " ") + element.size() + 9));
    };
    std::vector<Vec3> points(count("vertex"));
    std::memcpy(points.data(), at, points.size() * sizeof(Vec3));
    at += points.size() * sizeof(Vec3);
    std::vector<Corners> triangles(count("face"));
    for (Corners& corners : triangles) {
        EXPECT_EQ(*at++, 3);
        std::array<std::uint32_t, 3> indices{};
        std::memcpy(indices.data(), at, sizeof indices);
        at += sizeof indices;
        for (std::size_t i = 0; i < 3; ++i) corners[i] = points.at(indices[i]);
    }
    EXPECT_EQ(at, bytes.data() + bytes.size());
    return triangles;
}

RC_GTEST_PROP(ExportMitsuba, TheCameraSeesEveryPixelAlongOurRay, ())
{
    Scene scene = exported_scene();
    scene.camera = any_camera();
    const Options options = any_options();
    const MitsubaFile file(scene, options);
    const auto& sensor = file.element("sensor", "perspective");
    const std::vector<double> to_world = mitsuba_matrix(sensor);
    RC_ASSERT(transformed(to_world, Vec3(0.0), 1.0) == scene.camera->eye);
    const double tan_half = glm::tan(glm::radians(std::stod(value_of(sensor, "fov")) / 2.0));
    const double aspect = static_cast<double>(options.width) / options.height;
    const bool along_x = value_of(sensor, "fov_axis") == "x";
    const double x = along_x ? tan_half : tan_half * aspect;
    const double y = along_x ? tan_half / aspect : tan_half;
    expect_our_rays(
        *scene.camera, options,
        [&](double u, double v) { // +z forward, +x to the left, +y up
            return transformed(to_world, Vec3((1 - 2 * u) * x, (1 - 2 * v) * y, 1.0), 0.0);
        },
        1e-12);
    const auto& film = *sensor.FirstChildElement("film");
    RC_ASSERT(value_of(film, "width") == std::to_string(options.width));
    RC_ASSERT(value_of(film, "height") == std::to_string(options.height));
}

TEST(ExportMitsuba, TrianglesKeepTheirBitsAndWindingAndTheEmitterItsSide)
{
    const Scene scene = exported_scene();
    const MitsubaFile file(scene);
    for (const std::uint32_t material : {0u, 1u}) {
        const auto& shape = file.element("shape", "ply", static_cast<int>(material));
        EXPECT_EQ(value_of(shape, "filename"), file.exported.files[material].name);
        EXPECT_EQ(value_of(shape, "face_normals"), "true");
        EXPECT_EQ(triangles_in_ply(file.exported.files[material].bytes), triangles_of(scene, material));
        const auto* light = shape.FirstChildElement("emitter");
        ASSERT_EQ(light != nullptr, material == 1);
        if (light == nullptr) continue;
        EXPECT_TRUE(light->Attribute("type", "area"));
        EXPECT_EQ(vector_in(value_of(*light, "radiance")), Rgb(17.3, 5.1, 2.0 / 3.0));
    }
    EXPECT_EQ(
        vector_in(value_of(*file.element("bsdf", "twosided").FirstChildElement("bsdf"), "reflectance")),
        Rgb(0.1, 1.0 / 3.0, 0.7));
    EXPECT_EQ(vector_in(value_of(file.element("bsdf", "diffuse"), "reflectance")), Rgb(0.0));
}

TEST(ExportMitsuba, SpheresMaterialsAndLightsKeepTheirNumbers)
{
    Scene scene = exported_scene();
    scene.materials.emplace_back(scenes::Mirror{Rgb(0.9, 0.8, 0.7)});
    scene.materials.emplace_back(scenes::Glass{Rgb(0.6, 0.5, 0.4), Rgb(0.3, 0.2, 0.1), 1.33});
    scene.material_names.insert(scene.material_names.end(), {"mirror", "glass"});
    scene.spheres = {{Vec3(1, 2, 3.3), 0.1, 2}, {Vec3(4, 5, 6), 0.2, 3}, {Vec3(7, 8, 9), 0.3, 1}};
    scene.point_lights = {{Vec3(0.1, 0.2, 0.3), Rgb(1.1, 2.2, 3.3)}, {Vec3(1), Rgb(0.0)}};
    const Vec3 w = glm::normalize(Vec3(1, -2, 3));
    scene.directional_lights = {{w, Rgb(4.4, 5.5, 6.6)}};
    scene.spot_lights = {{Vec3(7, 8, 9), w, Rgb(7.7, 8.8, 9.9), glm::cos(glm::radians(25.0)), 0.0}};
    scene.environment = Rgb(0.3, 0.2, 0.1);
    const MitsubaFile file(scene);
    for (int i = 0; i < 3; ++i) {
        const auto& sphere = file.element("shape", "sphere", i);
        EXPECT_EQ(vector_in(value_of(sphere, "center")),
                  scene.spheres[static_cast<std::size_t>(i)].center);
        EXPECT_EQ(std::stod(value_of(sphere, "radius")),
                  scene.spheres[static_cast<std::size_t>(i)].radius);
        EXPECT_EQ(sphere.FirstChildElement("emitter") != nullptr, i == 2);
    }
    const auto& mirror = *file.element("bsdf", "twosided", 1).FirstChildElement("bsdf");
    EXPECT_TRUE(mirror.Attribute("type", "conductor"));
    EXPECT_EQ(value_of(mirror, "material"), "none");
    EXPECT_EQ(vector_in(value_of(mirror, "specular_reflectance")), Rgb(0.9, 0.8, 0.7));
    const auto& glass = file.element("bsdf", "dielectric");
    EXPECT_EQ(value_of(glass, "int_ior"), "1.33");
    EXPECT_EQ(value_of(glass, "ext_ior"), "1");
    EXPECT_EQ(vector_in(value_of(glass, "specular_reflectance")), Rgb(0.6, 0.5, 0.4));
    EXPECT_EQ(vector_in(value_of(glass, "specular_transmittance")), Rgb(0.3, 0.2, 0.1));

    EXPECT_EQ(vector_in(value_of(file.element("emitter", "point"), "position")), Vec3(0.1, 0.2, 0.3));
    EXPECT_EQ(vector_in(value_of(file.element("emitter", "point"), "intensity")), Rgb(1.1, 2.2, 3.3));
    EXPECT_THROW((void)file.element("emitter", "point", 1), std::runtime_error) << "a black light";
    EXPECT_EQ(vector_in(value_of(file.element("emitter", "directional"), "direction")), w);
    EXPECT_EQ(vector_in(value_of(file.element("emitter", "directional"), "irradiance")),
              Rgb(4.4, 5.5, 6.6));
    const auto& spot = file.element("emitter", "spot");
    EXPECT_EQ(vector_in(value_of(spot, "intensity")), Rgb(7.7, 8.8, 9.9));
    EXPECT_EQ(value_of(spot, "cutoff_angle"), "25");
    EXPECT_EQ(value_of(spot, "beam_width"), "25");
    EXPECT_EQ(transformed(mitsuba_matrix(spot), Vec3(0, 0, 1), 0.0), w);
    EXPECT_EQ(transformed(mitsuba_matrix(spot), Vec3(0.0), 1.0), Vec3(7, 8, 9));
    EXPECT_EQ(vector_in(value_of(file.element("emitter", "constant"), "radiance")), Rgb(0.3, 0.2, 0.1));
}

TEST(ExportMitsuba, LongestPathsAndSamplesAreThoseOfTheOptions)
{
    Options options;
    options.max_edges = 6;
    options.samples = 123;
    const MitsubaFile limited(exported_scene(), options);
    EXPECT_EQ(value_of(limited.element("integrator", "path"), "max_depth"), "6");
    EXPECT_EQ(value_of(limited.element("integrator", "path"), "rr_depth"), "7");
    const auto& sensor = limited.element("sensor", "perspective");
    EXPECT_EQ(value_of(*sensor.FirstChildElement("sampler"), "sample_count"), "123");
    const MitsubaFile unlimited(exported_scene());
    EXPECT_EQ(value_of(unlimited.element("integrator", "path"), "max_depth"), "-1");
    EXPECT_THROW(value_of(unlimited.element("integrator", "path"), "rr_depth"), std::runtime_error);
}

RC_GTEST_PROP(ExportNumbers, ReadBackAsTheSame, (double value))
{
    RC_ASSERT(std::strtod(scenes::exports::exact(value).c_str(), nullptr) == value);
}

TEST(ExportNumbers, AnglesReadBackAsTheSameAndAreShort)
{
    for (int hundredths = 1; hundredths < 18000; ++hundredths) {
        const std::string text = scenes::exports::degrees(glm::radians(hundredths / 100.0));
        ASSERT_EQ(text, scenes::exports::exact(hundredths / 100.0));
    }
    const double radians = 1.0;
    EXPECT_EQ(glm::radians(std::stod(scenes::exports::degrees(radians))), radians);
}

} // namespace
