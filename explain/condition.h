#pragma once

// Conditions on a strategy of a sample, as text: "s=2,t=2,weight>0.5".

#include "explain/sample.h"

#include <functional>
#include <string>
#include <vector>

namespace explain {

/// All terms, separated by commas, must hold for one and the same strategy. A term is a name, one of =
/// != < <= > >=, and a number: s, t, edges (of the path), weight (by the heuristic in use), value
/// (without weight) and adds (with weight), the last two of the largest channel. `family` and `obstacle`
/// take = or
/// != and a name (names.h). Unless `obstacle` is among the terms, the strategy must contribute.
class Condition {
public:
    /// Throws std::invalid_argument that names the wrong term.
    explicit Condition(const std::string& text);

    [[nodiscard]] const std::string& text() const { return text_; }
    [[nodiscard]] bool holds(const Strategy& strategy) const;
    /// Whether strategies that contribute nothing can fulfil it.
    [[nodiscard]] bool has_obstacle() const { return has_obstacle_; }

private:
    void add_term(const std::string& term);

    std::string text_;
    std::vector<std::function<bool(const Strategy&)>> terms_;
    bool has_obstacle_ = false;
};

} // namespace explain
