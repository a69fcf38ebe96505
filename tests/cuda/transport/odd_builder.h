#pragma once

// Builds odd scenes: with numbers that are the same on every platform, in a frame in which no
// coordinate is exact (or all are). Builds two scenes at once: the full one, and the plain one without
// the additions that change nothing.

#include "scenes/scene.h"

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace fast_transport_test {

class OddBuilder {
public:
    using Vec3 = scenes::Vec3;
    using Rgb = scenes::Rgb;

    explicit OddBuilder(std::uint32_t seed);

    // Random numbers. The distributions of the standard library differ between platforms; these do
    // not.
    double any(double low, double high);      // uniform
    double any_size(double low, double high); // uniform logarithm; 0 < low
    bool chance(double probability) { return any(0, 1) < probability; }
    int pick(int count) { return static_cast<int>(any(0, count)); } // 0 ... count - 1
    Rgb any_colour(double low, double high);
    Vec3 any_direction();

    /// Whether the frame is that of the file, so that lines along an axis are exactly along it.
    [[nodiscard]] bool exact() const { return exact_; }
    [[nodiscard]] double size() const { return size_; }
    /// A factor by which all light below is multiplied.
    [[nodiscard]] double brightness() const { return brightness_; }
    [[nodiscard]] Vec3 place(const Vec3& p) const;
    [[nodiscard]] Vec3 turn(const Vec3& w) const;

    // All functions below take coordinates of the frame.
    std::uint32_t add_material(const scenes::Material& material, const std::string& name);
    void add_triangle(const Vec3& a, const Vec3& b, const Vec3& c, std::uint32_t material);
    /// The parallelogram p + a [0, 1] + b [0, 1], facing the direction a x b.
    void add_quad(const Vec3& p, const Vec3& a, const Vec3& b, std::uint32_t material);
    /// An axis-aligned box whose faces share their corners to the last bit, without the face of number
    /// `without` (0 ... 5: low x, high x, low y, ...; -1: closed).
    void add_box(const Vec3& low, const Vec3& high, std::uint32_t material, bool outwards,
                 int without = -1);
    void add_sphere(const Vec3& center, double radius, std::uint32_t material);
    /// Intensities are given for a unit of length of 1.
    void add_point_light(const Vec3& p, const Rgb& intensity);
    void add_spot_light(const Vec3& p, const Vec3& w, const Rgb& intensity, double cos_cutoff,
                        double exponent);
    void add_sun(const Vec3& w, const Rgb& irradiance);
    void set_sky(const Rgb& radiance);
    /// `roll`: an angle about the viewing direction. `fov`: for both axes, since pictures are square.
    void look(const Vec3& from, const Vec3& along, double roll, double fov);

    /// The calls until the next switch_to add to one of the two scenes, or to both.
    enum class To { both, plain, full };
    void switch_to(To to) { to_ = to; }

    /// Appends to the description.
    void say(const std::string& what) { said_ += (said_.empty() ? "" : "; ") + what; }
    void say(const std::string& what, double number);

    [[nodiscard]] const scenes::Scene& plain() const { return plain_; }
    [[nodiscard]] const scenes::Scene& full() const { return full_; }
    [[nodiscard]] const std::string& said() const { return said_; }

private:
    /// Calls `add` with each scene that is currently selected.
    template <class Add>
    void each(const Add& add)
    {
        if (to_ != To::full) add(plain_);
        if (to_ != To::plain) add(full_);
    }

    std::mt19937 random_;
    bool exact_ = false;
    Vec3 origin_{0}, x_{1, 0, 0}, y_{0, 1, 0}, z_{0, 0, 1};
    double size_ = 1;
    double brightness_ = 1;
    To to_ = To::both;
    scenes::Scene plain_, full_;
    std::string said_;
};

} // namespace fast_transport_test
