#include "check/trees/report.h"

#include "check/trees/number_text.h"

#include <algorithm>
#include <sstream>

namespace check {

namespace {

std::string padded(std::string text, std::size_t width)
{
    text.resize(std::max(width, text.size()), ' ');
    return text;
}

std::string plural(std::size_t count, const std::string& noun, const std::string& nouns)
{
    return std::to_string(count) + " " + (count == 1 ? noun : nouns);
}

/// About four digits: enough for a ratio of costs.
std::string rounded_text(double x)
{
    std::ostringstream text;
    text.precision(4);
    text << x;
    return text.str();
}

std::string point_text(const ref::Vec3& point)
{
    return "(" + number_text(point.x) + ", " + number_text(point.y) + ", " + number_text(point.z) + ")";
}

const char* verdict_text(Property::Verdict verdict)
{
    switch (verdict) {
    case Property::Verdict::holds:
        return "holds";
    case Property::Verdict::fails:
        return "FAILS";
    case Property::Verdict::not_checked:
        return "  -  ";
    }
    return "";
}

void print_shape(std::ostream& out, const TreeReport::Shape& shape)
{
    if (shape.root == NeutralTree::none) return;
    out << "root: node " << shape.root << "; depth " << shape.depth << ", of leaves on average "
        << rounded_text(shape.mean_leaf_depth) << "; leaves of " << shape.smallest_leaf << " to "
        << plural(shape.largest_leaf, "primitive", "primitives") << "\n"
        << "leaves in the order of our Morton codes: of 30 bits "
        << (shape.in_order_of_30_bits ? "yes" : "no") << ", of 63 bits "
        << (shape.in_order_of_63_bits ? "yes" : "no") << "\n";
}

void print_input(std::ostream& out, const std::vector<ref::Aabb>& boxes)
{
    constexpr std::size_t shown = 8;
    for (std::size_t i = 0; i < std::min(boxes.size(), shown); ++i)
        out << "  primitive " << i << ": " << point_text(boxes[i].lower) << " to "
            << point_text(boxes[i].upper) << "\n";
    if (boxes.size() > shown) out << "  and " << boxes.size() - shown << " more\n";
}

} // namespace

std::string describe(const TreeReport& report)
{
    std::ostringstream out;
    out << plural(report.primitives, "primitive", "primitives") << ", "
        << plural(report.nodes, "node", "nodes") << ", " << plural(report.leaves, "leaf", "leaves")
        << "\n";
    for (const Property& property : report.properties) {
        out << verdict_text(property.verdict) << "  " << padded(property.name, 13) << property.meaning
            << "\n";
        if (property.verdict != Property::Verdict::fails) continue;
        out << "       " << property.example;
        if (property.violations > 1) out << " (the first of " << property.violations << " violations)";
        out << "\n";
    }
    if (report.shape) print_shape(out, *report.shape);
    if (report.costs)
        out << "SAH cost: " << rounded_text(report.costs->tree)
            << "; of our LBVH over the same primitives " << rounded_text(report.costs->lbvh)
            << ", of our SAH tree " << rounded_text(report.costs->sah) << "\n";
    return out.str();
}

std::string describe(const BuilderReport& report)
{
    std::ostringstream out;
    std::size_t tried = 0;
    for (const BuilderReport::Kind& kind : report.kinds) {
        tried += kind.tried;
        if (kind.tried == 0) continue;
        out << padded(name(kind.kind), 11);
        if (kind.problem.any())
            out << "FAILS for n = " << kind.failing << ": " << kind.problem.name << ": "
                << kind.problem.text;
        else
            out << plural(kind.tried, "input", "inputs") << " to n = " << kind.largest << " fine";
        out << "\n";
    }
    if (!report.kinds.empty())
        out << tried << " of " << report.planned << " inputs tried"
            << (report.budget_spent ? ", then the budget was spent" : "")
            << (report.stopped ? ", then interrupted" : "") << "\n";
    if (!report.smallest) return out.str();

    const SmallestFailure& smallest = *report.smallest;
    out << "The smallest input that fails (" << plural(smallest.tries, "run", "runs")
        << " to find it): " << plural(smallest.boxes.size(), "primitive", "primitives") << "\n";
    print_input(out, smallest.boxes);
    out << smallest.problem.name << ": " << smallest.problem.text << "\n";
    if (smallest.failed_again < smallest.runs_again)
        out << "It fails only now and then: in " << smallest.failed_again << " of "
            << plural(smallest.runs_again, "further run", "further runs") << ". A race?\n";
    return out.str();
}

} // namespace check
