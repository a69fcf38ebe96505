#pragma once

#include <ImfIO.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace images {

/// The bytes of a file as OpenEXR reads them. The bytes must outlive it.
class MemoryInput : public Imf::IStream {
public:
    MemoryInput(const std::string& name, std::string_view bytes);
    /// Throws Iex::InputExc behind the last byte.
    bool read(char data[], int size) override;
    std::uint64_t tellg() override;
    void seekg(std::uint64_t position) override;

private:
    std::string_view bytes_;
    std::size_t position_ = 0;
};

} // namespace images
