// pbrt-v4 [https://pbrt.org/fileformat-v4]: RGB light is the standard illuminant scaled so that the film
// records the same RGB, and an area light shines on the side of (p1 - p0) x (p2 - p0), as in Plumbline.

#include "scenes/export/pbrt.h"

#include "scenes/export/exact.h"
#include "scenes/export/surfaces.h"
#include "scenes/for_each_light.h"
#include "scenes/is_emitter.h"

#include <set>

namespace scenes::exports {
namespace {

/// The mirror that reflects everything: a conductor whose index is so large that less than one part in
/// 10^11 is absorbed at normal incidence: k^2 / (4 + k^2).
constexpr const char* all_mirror = "plumbline_mirror";
constexpr const char* all_black = "plumbline_black";

class PbrtWriter {
public:
    PbrtWriter(const Scene& scene, const Options& options) : scene_(scene), options_(options) {}

    Exported write(const std::string& file_name)
    {
        settings(stem_of(file_name) + ".exr");
        text_ += "WorldBegin\n";
        const std::vector<Mesh> meshes = meshes_of(scene_);
        define_materials(meshes);
        for_each_light(scene_, [&](const auto& light, std::size_t index) {
            if (is_emitter(light)) source(light, index);
        });
        if (has_environment(scene_))
            line(R"(LightSource "infinite" "rgb L" )" + list(colour(*scene_.environment)));
        for (const Mesh& mesh : meshes) shape(mesh);
        for (const Sphere& sphere : scene_.spheres) shape(sphere);
        Exported result{{{file_name, std::move(text_)}}, {}};
        if (coloured_)
            result.notices.emplace_back(
                "pbrt renders spectra: a product of colours, such as that of two "
                "coloured surfaces, differs from that of RGB");
        return result;
    }

private:
    void line(const std::string& text) { text_ += text + "\n"; }
    static std::string list(const std::string& values) { return "[ " + values + " ]"; }
    static std::string list(const Vec3& v) { return list(exact(v, " ")); }

    /// Remembers whether there is any colour.
    const Rgb& colour(const Rgb& rgb)
    {
        coloured_ = coloured_ || !is_grey(rgb);
        return rgb;
    }

    void settings(const std::string& picture)
    {
        // Its maxdepth counts the vertices between the camera and the emitter. Without a limit, roulette
        // ends every path.
        const int max_depth = options_.max_edges.value_or(1000000) - 1;
        line(R"(Film "rgb" "string filename" )" + quoted(picture) + R"( "integer xresolution" [ )" +
             std::to_string(options_.width) + R"( ] "integer yresolution" [ )" +
             std::to_string(options_.height) + " ]");
        line(R"(PixelFilter "box" "float xradius" [ 0.5 ] "float yradius" [ 0.5 ])");
        line(R"(Sampler "independent" "integer pixelsamples" [ )" + std::to_string(options_.samples) +
             " ]");
        line(R"(Integrator "path" "integer maxdepth" [ )" + std::to_string(max_depth) + " ]");
        camera();
    }

    /// pbrt's camera looks along +z with +x to the right. Transform lists the columns of the matrix from
    /// the world to the camera, whose rows are the camera's axes; Translate is applied before it.
    void camera()
    {
        const Camera& camera = *scene_.camera;
        std::string columns;
        for (int i = 0; i < 3; ++i)
            columns += exact(camera.right[i]) + " " + exact(camera.up[i]) + " " +
                       exact(-camera.backward[i]) + " 0 ";
        line("Transform " + list(columns + "0 0 0 1"));
        line("Translate " + exact(-camera.eye, " "));
        // The field of view spans -1 to 1 of the window on the screen.
        const double aspect = static_cast<double>(options_.width) / options_.height;
        const bool horizontal = camera.fov_axis == FovAxis::horizontal;
        const double x = horizontal ? 1.0 : aspect;
        const double y = horizontal ? static_cast<double>(options_.height) / options_.width : 1.0;
        line(R"(Camera "perspective" "float fov" [ )" + degrees(camera.fov) +
             R"( ] "float screenwindow" [ )" + exact(-x) + " " + exact(x) + " " + exact(-y) + " " +
             exact(y) + " ]");
    }

    static std::string quoted(const std::string& name)
    {
        std::string text = "\"";
        for (const char c : name) {
            if (c == '"' || c == '\\') text += '\\';
            text += c;
        }
        return text + "\"";
    }

    void define_materials(const std::vector<Mesh>& meshes)
    {
        std::set<std::uint32_t> used;
        for (const Mesh& mesh : meshes) used.insert(mesh.material);
        for (const Sphere& sphere : scene_.spheres) used.insert(sphere.material);
        define(all_black, R"("string type" "diffuse" "rgb reflectance" [ 0 0 0 ])");
        define(all_mirror, R"("string type" "conductor" "float roughness" [ 0 ] )"
                           R"("spectrum eta" [ 300 1 900 1 ] "spectrum k" [ 300 1e6 900 1e6 ])");
        for (const std::uint32_t material : used)
            std::visit([&](const auto& kind) { define(kind, material); }, scene_.materials[material]);
    }
    void define(const std::string& name, const std::string& parameters)
    {
        line("MakeNamedMaterial " + quoted(name) + " " + parameters);
    }
    void define(const Lambertian& lambertian, std::uint32_t material)
    {
        define(unique_name(scene_, material),
               R"("string type" "diffuse" "rgb reflectance" )" + list(colour(lambertian.albedo)));
    }
    /// A mirror that reflects a part of all light: a random choice between one that reflects everything
    /// and black.
    void define(const Mirror& mirror, std::uint32_t material)
    {
        if (!is_grey(mirror.reflectance))
            refuse(scene_, material_name(scene_, material), "pbrt-v4 has no coloured mirror");
        define(unique_name(scene_, material),
               R"("string type" "mix" "string materials" [ )" + quoted(all_black) + " " +
                   quoted(all_mirror) + R"( ] "float amount" [ )" + exact(mirror.reflectance.x) + " ]");
    }
    void define(const Glass& glass, std::uint32_t material)
    {
        if (glass.reflectance != Rgb(1.0) || glass.transmittance != Rgb(1.0))
            refuse(
                scene_, material_name(scene_, material),
                "pbrt-v4 has no glass that absorbs at its surface (reflectance and transmittance must "
                "be 1)");
        define(unique_name(scene_, material),
               R"("string type" "dielectric" "float roughness" [ 0 ] "float eta" [ )" +
                   exact(glass.ior) + " ]");
    }
    void define(const Emission& /*emission*/, std::uint32_t /*material*/) {} // all are black

    /// The shape that follows is of this material; the attributes end with the shape.
    void surface(std::uint32_t material)
    {
        line("AttributeBegin");
        const auto* emission = std::get_if<Emission>(&scene_.materials[material]);
        if (emission != nullptr && emits(*emission))
            line(R"(AreaLightSource "diffuse" "rgb L" )" + list(colour(emission->radiance)));
        line("NamedMaterial " + quoted(emission != nullptr ? all_black : unique_name(scene_, material)));
    }
    void shape(const Mesh& mesh)
    {
        surface(mesh.material);
        line(R"(Shape "trianglemesh" "integer indices" [)");
        for (const auto& [a, b, c] : mesh.triangles)
            line(std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c));
        line(R"(] "point3 P" [)");
        for (const Vec3& point : mesh.points) line(exact(point, " "));
        line("]");
        line("AttributeEnd");
    }
    void shape(const Sphere& sphere)
    {
        surface(sphere.material);
        line("Translate " + exact(sphere.center, " "));
        line(R"(Shape "sphere" "float radius" [ )" + exact(sphere.radius) + " ]");
        line("AttributeEnd");
    }

    void source(const PointLight& light, std::size_t /*index*/)
    {
        line(R"(LightSource "point" "rgb I" )" + list(colour(light.intensity)) + R"( "point3 from" )" +
             list(light.position));
    }
    void source(const DirectionalLight& light, std::size_t /*index*/)
    {
        line(R"(LightSource "distant" "rgb L" )" + list(colour(light.irradiance)) +
             R"( "point3 from" [ 0 0 0 ] "point3 to" )" + list(light.direction));
    }
    void source(const SpotLight& light, std::size_t index)
    {
        expect_constant(scene_, light, index, "pbrt-v4");
        // Placed by the transform: from + direction would round.
        const auto [x, y, z] = frame_of(light.direction);
        line("AttributeBegin");
        line("Translate " + exact(light.position, " "));
        line("ConcatTransform " +
             list(exact(x, " ") + " 0 " + exact(y, " ") + " 0 " + exact(z, " ") + " 0 0 0 0 1"));
        line(R"(LightSource "spot" "rgb I" )" + list(colour(light.intensity)) +
             R"( "point3 from" [ 0 0 0 ] "point3 to" [ 0 0 1 ] "float coneangle" [ )" +
             cone_degrees(light) + R"( ] "float conedeltaangle" [ 0 ])");
        line("AttributeEnd");
    }

    const Scene& scene_;
    const Options& options_;
    std::string text_;
    bool coloured_ = false;
};

} // namespace

Exported to_pbrt(const Scene& scene, const Options& options, const std::string& file_name)
{
    return PbrtWriter(scene, options).write(file_name);
}

} // namespace scenes::exports
