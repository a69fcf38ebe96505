#pragma once

// The folder with a renderer's pictures: a temporary one, or one that is kept and gone on with.

#include "check/renderers/suite.h"
#include "images/temporary_folder.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace check {

/// What a kept picture depends on besides its scene and number.
struct Origin {
    std::vector<std::string> command;
    std::uint64_t samples;
    std::uint64_t series;
    std::string ending; // of the pictures' names: ".exr" or ".pfm"
};

/// Pictures by scene and number. Kept ones lie at SCENE/NUMBER.exr; beside them pictures.json states
/// their origin.
class PictureFolder {
public:
    /// A temporary folder, removed with all that is in it by the destructor. Throws as
    /// images::TemporaryFolder.
    PictureFolder();

    /// The folder `kept`, which is made if it does not exist. Throws std::invalid_argument if it holds
    /// pictures of another origin or of other scenes: of a command with other words, or of a program,
    /// script or other file named in the command that has changed since; images::ImageError if it cannot
    /// be written.
    PictureFolder(const std::filesystem::path& kept, const Origin& origin,
                  const std::vector<SuiteScene>& scenes);

    [[nodiscard]] bool is_kept() const { return !temporary_; }

    /// The place of a finished picture, an absolute path. `number` is at least 1.
    [[nodiscard]] std::filesystem::path place(const std::string& scene, std::uint64_t number,
                                              const std::string& ending) const;

    /// Where the renderer writes it: beside its place, so that an unfinished picture is never taken for
    /// a finished one. Makes the scene's folder.
    [[nodiscard]] std::filesystem::path unfinished(const std::string& scene, std::uint64_t number,
                                                   const std::string& ending) const;

private:
    std::optional<images::TemporaryFolder> temporary_; // none: the folder is kept
    std::filesystem::path folder_;
};

} // namespace check
