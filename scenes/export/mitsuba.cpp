// Mitsuba 3 [https://mitsuba.readthedocs.io]: units, sides and edges are Plumbline's own. The path
// integrator's max_depth counts edges, and an area emitter shines on the side of the normal.

#include "scenes/export/mitsuba.h"

#include "scenes/export/exact.h"
#include "scenes/export/ply.h"
#include "scenes/export/surfaces.h"
#include "scenes/for_each_light.h"
#include "scenes/is_emitter.h"

#include <tinyxml2.h>

namespace scenes::exports {
namespace {

/// Writes elements such as <float name="radius" value="1"/>.
class MitsubaWriter {
public:
    MitsubaWriter(const Scene& scene, const Options& options) : scene_(scene), options_(options) {}

    std::string write(const std::vector<Mesh>& meshes, const std::vector<std::string>& mesh_files)
    {
        xml_.OpenElement("scene");
        xml_.PushAttribute("version", "3.0.0");
        integrator();
        sensor();
        for (const Mesh& mesh : meshes) bsdf(mesh.material);
        for (const Sphere& sphere : scene_.spheres) bsdf(sphere.material);
        for (std::size_t i = 0; i < meshes.size(); ++i) {
            open("shape", "ply");
            value("string", "filename", mesh_files[i]);
            value("boolean", "face_normals", "true");
            surface(meshes[i].material);
        }
        for (const Sphere& sphere : scene_.spheres) {
            open("shape", "sphere");
            value("point", "center", exact(sphere.center, ", "));
            value("float", "radius", exact(sphere.radius));
            surface(sphere.material);
        }
        for_each_light(scene_, [&](const auto& light, std::size_t index) {
            if (is_emitter(light)) emitter(light, index);
        });
        if (has_environment(scene_)) {
            open("emitter", "constant");
            rgb("radiance", *scene_.environment);
            close();
        }
        close();
        return xml_.CStr();
    }

private:
    void open(const char* element, const char* type)
    {
        xml_.OpenElement(element);
        xml_.PushAttribute("type", type);
    }
    void close() { xml_.CloseElement(); }
    void value(const char* element, const char* name, const std::string& value)
    {
        xml_.OpenElement(element);
        xml_.PushAttribute("name", name);
        xml_.PushAttribute("value", value.c_str());
        xml_.CloseElement();
    }
    void rgb(const char* name, const Rgb& colour) { value("rgb", name, exact(colour, ", ")); }

    /// Without a limit Mitsuba needs its roulette; with one, roulette would begin after the last edge.
    void integrator()
    {
        open("integrator", "path");
        value("integer", "max_depth", std::to_string(options_.max_edges.value_or(-1)));
        if (options_.max_edges) value("integer", "rr_depth", std::to_string(*options_.max_edges + 1));
        close();
    }

    /// The matrix whose columns are these three axes and the origin.
    void to_world(const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& origin)
    {
        std::string rows;
        for (int i = 0; i < 3; ++i)
            rows += exact(x[i]) + " " + exact(y[i]) + " " + exact(z[i]) + " " + exact(origin[i]) + " ";
        xml_.OpenElement("transform");
        xml_.PushAttribute("name", "to_world");
        xml_.OpenElement("matrix");
        xml_.PushAttribute("value", (rows + "0 0 0 1").c_str());
        close();
        close();
    }

    /// Mitsuba's camera looks along its +z, with +x to the left in the picture. It cuts away what is not
    /// between the clipping planes: all of the scene is.
    void sensor()
    {
        constexpr double near_of_far = 1e-6;
        const Camera& camera = *scene_.camera;
        const double far_clip = reach_of(scene_);
        open("sensor", "perspective");
        value("string", "fov_axis", camera.fov_axis == FovAxis::horizontal ? "x" : "y");
        value("float", "fov", degrees(camera.fov));
        value("float", "near_clip", exact(near_of_far * far_clip));
        value("float", "far_clip", exact(far_clip));
        to_world(-camera.right, camera.up, -camera.backward, camera.eye);
        open("sampler", "independent");
        value("integer", "sample_count", std::to_string(options_.samples));
        close();
        open("film", "hdrfilm");
        value("integer", "width", std::to_string(options_.width));
        value("integer", "height", std::to_string(options_.height));
        value("string", "pixel_format", "rgb");
        value("string", "component_format", "float32");
        open("rfilter", "box");
        close();
        close();
        close();
    }

    /// Defines the BSDF of a material, once.
    void bsdf(std::uint32_t material)
    {
        if (defined_.size() < scene_.materials.size()) defined_.resize(scene_.materials.size());
        if (defined_[material]) return;
        defined_[material] = true;
        const std::string id = unique_name(scene_, material);
        std::visit([&](const auto& kind) { bsdf(kind, id.c_str()); }, scene_.materials[material]);
    }
    void open_two_sided(const char* id, const char* type)
    {
        open("bsdf", "twosided");
        xml_.PushAttribute("id", id);
        open("bsdf", type);
    }
    void bsdf(const Lambertian& lambertian, const char* id)
    {
        open_two_sided(id, "diffuse");
        rgb("reflectance", lambertian.albedo);
        close();
        close();
    }
    void bsdf(const Mirror& mirror, const char* id)
    {
        open_two_sided(id, "conductor");
        value("string", "material", "none");
        rgb("specular_reflectance", mirror.reflectance);
        close();
        close();
    }
    void bsdf(const Glass& glass, const char* id)
    {
        open("bsdf", "dielectric");
        xml_.PushAttribute("id", id);
        value("float", "int_ior", exact(glass.ior));
        value("float", "ext_ior", "1");
        rgb("specular_reflectance", glass.reflectance);
        rgb("specular_transmittance", glass.transmittance);
        close();
    }
    void bsdf(const Emission& /*emission*/, const char* id)
    {
        open("bsdf", "diffuse"); // black: an emitter reflects nothing
        xml_.PushAttribute("id", id);
        rgb("reflectance", Rgb(0.0));
        close();
    }

    /// The end of a shape: its material, and its light.
    void surface(std::uint32_t material)
    {
        xml_.OpenElement("ref");
        xml_.PushAttribute("id", unique_name(scene_, material).c_str());
        close();
        if (emits(scene_.materials[material])) {
            open("emitter", "area");
            rgb("radiance", std::get<Emission>(scene_.materials[material]).radiance);
            close();
        }
        close();
    }

    void emitter(const PointLight& light, std::size_t /*index*/)
    {
        open("emitter", "point");
        value("point", "position", exact(light.position, ", "));
        rgb("intensity", light.intensity);
        close();
    }
    void emitter(const DirectionalLight& light, std::size_t /*index*/)
    {
        open("emitter", "directional");
        value("vector", "direction", exact(light.direction, ", "));
        rgb("irradiance", light.irradiance);
        close();
    }
    /// Mitsuba's spot light is constant up to beam_width and then fades linearly to cutoff_angle.
    void emitter(const SpotLight& light, std::size_t index)
    {
        expect_constant(scene_, light, index, "Mitsuba");
        const auto [x, y, z] = frame_of(light.direction);
        open("emitter", "spot");
        rgb("intensity", light.intensity);
        value("float", "cutoff_angle", cone_degrees(light));
        value("float", "beam_width", cone_degrees(light));
        to_world(x, y, z, light.position);
        close();
    }

    const Scene& scene_;
    const Options& options_;
    tinyxml2::XMLPrinter xml_;
    std::vector<bool> defined_; // by material
};

} // namespace

Exported to_mitsuba(const Scene& scene, const Options& options, const std::string& file_name)
{
    const std::vector<Mesh> meshes = meshes_of(scene);
    Exported result;
    std::vector<std::string> names;
    for (const Mesh& mesh : meshes) {
        names.push_back(stem_of(file_name) + "." + unique_name(scene, mesh.material) + ".ply");
        result.files.push_back({names.back(), ply_of(mesh)});
    }
    result.files.push_back({file_name, MitsubaWriter(scene, options).write(meshes, names)});
    return result;
}

} // namespace scenes::exports
