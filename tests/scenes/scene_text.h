#pragma once

// COLLADA files for tests, put together from parts. The part that a test is about is written in the
// test, the rest here.

#include "scenes/read_scene.h"

#include <charconv>
#include <string>

namespace transport_test {

/// The text of a file; each part is put into its library.
struct SceneText {
    std::string cameras;
    std::string lights;
    std::string effects;   // beside "grey-effect"
    std::string materials; // beside "grey"
    std::string geometries;
    std::string library_nodes;
    std::string nodes; // of the visual scene

    [[nodiscard]] std::string str() const
    {
        return "<COLLADA version=\"1.4.1\">"
               "<library_cameras>" +
               cameras +
               "</library_cameras>"
               "<library_lights>" +
               lights +
               "</library_lights>"
               "<library_effects>"
               "<effect id=\"grey-effect\"><profile_COMMON><technique sid=\"common\"><lambert>"
               "<diffuse><color>0.5 0.5 0.5 "
               "1</color></diffuse></lambert></technique></profile_COMMON></effect>" +
               effects +
               "</library_effects>"
               "<library_materials>"
               "<material id=\"grey\"><instance_effect url=\"#grey-effect\"/></material>" +
               materials +
               "</library_materials>"
               "<library_geometries>" +
               geometries +
               "</library_geometries>"
               "<library_nodes>" +
               library_nodes +
               "</library_nodes>"
               "<library_visual_scenes><visual_scene id=\"scene\">" +
               nodes +
               "</visual_scene></library_visual_scenes>"
               "<scene><instance_visual_scene url=\"#scene\"/></scene>"
               "</COLLADA>";
    }

    [[nodiscard]] scenes::Scene parse() const { return scenes::parse_scene(str(), "test.dae"); }
};

/// The shortest decimal text that reads back as exactly `value`.
inline std::string exactly(double value)
{
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// An effect of the CMU462 profile and a material of it, both named after `id`.
inline void add_material(SceneText& text, const std::string& id, const std::string& cmu462)
{
    text.effects += "<effect id=\"" + id + "-effect\"><extra><technique profile=\"CMU462\">" + cmu462 +
                    "</technique></extra></effect>";
    text.materials +=
        "<material id=\"" + id + "\"><instance_effect url=\"#" + id + "-effect\"/></material>";
}

/// A mesh of one part with the symbol "m". `primitives` is a <triangles>, <polylist> or <polygons> that
/// takes its vertices from "#<id>-v".
inline std::string mesh(const std::string& id, const std::string& positions, std::size_t count,
                        const std::string& primitives)
{
    return "<geometry id=\"" + id + "\"><mesh><source id=\"" + id + "-p\"><float_array id=\"" + id +
           "-a\" count=\"" + std::to_string(3 * count) + "\">" + positions +
           "</float_array><technique_common><accessor source=\"#" + id + "-a\" count=\"" +
           std::to_string(count) +
           "\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
           "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source><vertices id=\"" +
           id + "-v\"><input semantic=\"POSITION\" source=\"#" + id + "-p\"/></vertices>" + primitives +
           "</mesh></geometry>";
}

/// One triangle (0,0,0), (1,0,0), (0,1,0): its normal is +z.
inline std::string triangle_mesh(const std::string& id)
{
    return mesh(id, "0 0 0 1 0 0 0 1 0", 3,
                "<triangles material=\"m\" count=\"1\"><input semantic=\"VERTEX\" source=\"#" + id +
                    "-v\" offset=\"0\"/><p>0 1 2</p></triangles>");
}

inline std::string sphere_geometry(const std::string& id, const std::string& radius)
{
    return "<geometry id=\"" + id + "\"><extra><technique profile=\"CMU462\"><sphere><radius>" + radius +
           "</radius></sphere></technique></extra></geometry>";
}

inline std::string instance_geometry(const std::string& geometry, const std::string& material = "grey")
{
    return "<instance_geometry url=\"#" + geometry +
           "\"><bind_material><technique_common><instance_material symbol=\"m\" target=\"#" + material +
           "\"/></technique_common></bind_material></instance_geometry>";
}

inline std::string node(const std::string& content)
{
    return "<node>" + content + "</node>";
}

/// The message of the SceneError that parsing `text` raises; empty if it raises none.
inline std::string error_of(const SceneText& text)
{
    try {
        (void)text.parse();
    } catch (const scenes::SceneError& error) {
        return error.what();
    }
    return "";
}

} // namespace transport_test
