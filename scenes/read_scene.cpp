// Reads those parts of COLLADA 1.4.1 [Khronos 2008] that describe a picture of surfaces and lights at
// rest. The reader goes from the outside in:
//   document     well-formed XML, with the file, line and id of each element
//   nodes        the tree of nodes below <scene>, with its transforms
//   instances    geometries, lights and cameras, placed in the world
//   geometries   (positions, polygons, triangulate), materials, lights, cameras: one element each
//   animations   not followed; a notice for each that acts on an element of the picture
//
// An element is read when an instance needs it. Elements that nothing refers to are not read, so errors
// in them are not reported. Ids that are given twice are an error only where a reference to them is
// followed. Lengths are those of the file (<unit> is ignored). So are the axes: transforms are applied
// as written, and <up_axis> is ignored.

#include "scenes/read_scene.h"

#include "scenes/collada/animations.h"
#include "scenes/collada/document.h"
#include "scenes/collada/instances.h"
#include "scenes/collada/nodes.h"
#include "scenes/file_bytes.h"

namespace scenes {
namespace {

using namespace collada;

void check_root(const Element& root)
{
    if (std::string_view(root.Name()) != "COLLADA") fail(root, "not a COLLADA file");
    const std::string_view version = required_attribute(root, "version");
    if (version != "1.4.1" && version != "1.4.0")
        fail(root, "version " + in_quotes(version) + " is not 1.4.1");
    check_children(root, {"library_*", "scene"}); // libraries are read only where they are needed
}

} // namespace

Scene parse_scene(std::string_view xml, const std::string& file_name, Parts parts)
{
    const std::filesystem::path path(file_name);
    const Document document(xml, path.filename().string());
    const Element& root = document.root();
    check_root(root);
    const Element& scene_element = required_child(root, "scene");
    check_children(scene_element, {"instance_visual_scene"});
    const Element& instance = required_child(scene_element, "instance_visual_scene");

    Scene scene;
    scene.name = path.stem().string();
    scene.hash = hash_of(xml);
    Instances instances(document, scene, parts);
    NodeWalk(document, instances).visit_scene(document.target(instance, "url", "visual_scene"));
    instances.finish();
    notice_animations(document, scene.notices); // after reading: now the elements in use are known
    return scene;
}

Scene read_scene(const std::filesystem::path& path, Parts parts)
{
    return parse_scene(file_bytes(path), path.filename().string(), parts);
}

} // namespace scenes
