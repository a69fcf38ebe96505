#pragma once

// The part of pbrt-v4's file format that the exporter uses, from its documentation
// [https://pbrt.org/fileformat-v4]: directives, their types, and the type, name and number of values of
// their parameters. pbrt itself is not available as a package.

#include <cstdlib>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace scenes_test {

/// How many values each parameter takes, by "type name"; -3: a multiple of 3, at least one.
using PbrtParameters = std::map<std::string, int>;

/// Parameters by the directive and its type, such as "Shape sphere". Materials are named by their
/// "string type".
inline const std::map<std::string, PbrtParameters>& pbrt_directives()
{
    static const std::map<std::string, PbrtParameters> known = {
        {"Film rgb", {{"string filename", 1}, {"integer xresolution", 1}, {"integer yresolution", 1}}},
        {"PixelFilter box", {{"float xradius", 1}, {"float yradius", 1}}},
        {"Sampler independent", {{"integer pixelsamples", 1}}},
        {"Integrator path", {{"integer maxdepth", 1}}},
        {"Camera perspective", {{"float fov", 1}, {"float screenwindow", 4}}},
        {"LightSource point", {{"rgb I", 3}, {"point3 from", 3}}},
        {"LightSource distant", {{"rgb L", 3}, {"point3 from", 3}, {"point3 to", 3}}},
        {"LightSource spot",
         {{"rgb I", 3},
          {"point3 from", 3},
          {"point3 to", 3},
          {"float coneangle", 1},
          {"float conedeltaangle", 1}}},
        {"LightSource infinite", {{"rgb L", 3}}},
        {"AreaLightSource diffuse", {{"rgb L", 3}, {"bool twosided", 1}}},
        {"Shape sphere", {{"float radius", 1}}},
        {"Shape trianglemesh", {{"integer indices", -3}, {"point3 P", -3}}},
        {"material diffuse", {{"string type", 1}, {"rgb reflectance", 3}}},
        {"material conductor",
         {{"string type", 1}, {"float roughness", 1}, {"spectrum eta", -2}, {"spectrum k", -2}}},
        {"material dielectric", {{"string type", 1}, {"float roughness", 1}, {"float eta", 1}}},
        {"material mix", {{"string type", 1}, {"string materials", 2}, {"float amount", 1}}}};
    return known;
}

/// Reads a file; the first thing that the grammar does not know ends it with std::runtime_error.
class PbrtReader {
public:
    explicit PbrtReader(const std::string& text) : in_(text) {}

    void read()
    {
        for (std::string word; in_ >> word;) statement(word);
        expect(in_world_ && open_.empty(), "the end");
    }

private:
    static void expect(bool holds, const std::string& where)
    {
        if (!holds) throw std::runtime_error("not as pbrt wants it: " + where);
    }
    void statement(const std::string& word)
    {
        if (word == "WorldBegin") {
            expect(!in_world_, word);
            in_world_ = true;
        } else if (word == "AttributeBegin") {
            expect(in_world_, word);
            open_.push_back(word);
        } else if (word == "AttributeEnd") {
            expect(!open_.empty(), word);
            open_.pop_back();
        } else if (word == "Translate") {
            for (int i = 0; i < 3; ++i) number(word);
        } else if (word == "Transform" || word == "ConcatTransform") {
            std::string bracket;
            expect(in_ >> bracket && bracket == "[", word);
            for (int i = 0; i < 16; ++i) number(word);
            expect(in_ >> bracket && bracket == "]", word);
        } else if (word == "NamedMaterial") {
            expect(materials_.contains(quoted(word)), word);
        } else {
            with_parameters(word);
        }
    }
    void with_parameters(const std::string& word)
    {
        const bool of_world = word == "LightSource" || word == "AreaLightSource" || word == "Shape" ||
                              word == "MakeNamedMaterial";
        expect(of_world == in_world_, word);
        const std::string name = quoted(word);
        std::string kind = word + " " + name;
        const auto found = parameters(word);
        if (word == "MakeNamedMaterial") {
            expect(found.contains("string type"), word);
            kind = "material " + found.at("string type").front();
            if (found.contains("string materials"))
                for (const std::string& other : found.at("string materials"))
                    expect(materials_.contains(other), kind);
            expect(materials_.emplace(name, 0).second, word + " " + name);
        }
        const auto known = pbrt_directives().find(kind);
        expect(known != pbrt_directives().end(), kind);
        for (const auto& [parameter, values] : found) {
            const auto count = known->second.find(parameter);
            expect(count != known->second.end(), kind + ": " + parameter);
            const int n = static_cast<int>(values.size());
            expect(count->second > 0 ? n == count->second : n > 0 && n % -count->second == 0,
                   kind + ": " + parameter);
        }
    }
    /// Up to the next directive: "type name" followed by a value or by [ values ].
    std::map<std::string, std::vector<std::string>> parameters(const std::string& word)
    {
        std::map<std::string, std::vector<std::string>> found;
        while ((in_ >> std::ws).peek() == '"') {
            const std::string name = quoted(word);
            std::vector<std::string> values;
            if ((in_ >> std::ws).peek() != '[') {
                values.push_back(value(name));
            } else {
                in_.get();
                while ((in_ >> std::ws).peek() != ']') values.push_back(value(name));
                in_.get();
            }
            expect(found.emplace(name, values).second, word + ": " + name);
        }
        return found;
    }
    /// One value of the type that the parameter names.
    std::string value(const std::string& parameter)
    {
        if (parameter.starts_with("string ")) return quoted(parameter);
        std::string text;
        expect(static_cast<bool>(in_ >> text), parameter);
        if (parameter.starts_with("bool "))
            expect(text == "true" || text == "false", parameter);
        else
            check_number(text, parameter);
        if (parameter.starts_with("integer "))
            expect(text.find_first_not_of("-0123456789") == std::string::npos, parameter);
        return text;
    }
    void number(const std::string& where)
    {
        std::string text;
        expect(static_cast<bool>(in_ >> text), where);
        check_number(text, where);
    }
    static void check_number(const std::string& text, const std::string& where)
    {
        char* end = nullptr;
        std::strtod(text.c_str(), &end);
        expect(end == text.c_str() + text.size() &&
                   text.find_first_not_of("+-.0123456789e") == std::string::npos,
               where + ": " + text);
    }
    std::string quoted(const std::string& where)
    {
        std::string text;
        expect((in_ >> std::ws).get() == '"', where);
        for (int c = 0; (c = in_.get()) != '"';) {
            if (c == '\\') c = in_.get();
            expect(c >= 0, where);
            text += static_cast<char>(c);
        }
        return text;
    }

    std::istringstream in_;
    std::vector<std::string> open_;
    std::map<std::string, int> materials_;
    bool in_world_ = false;
};

/// What pbrt would not read in `text`; empty if there is nothing.
inline std::string fault_in_pbrt(const std::string& text)
{
    try {
        PbrtReader(text).read();
    } catch (const std::runtime_error& fault) {
        return fault.what();
    }
    return "";
}

} // namespace scenes_test
