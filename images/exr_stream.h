#pragma once

#include <Iex.h>
#include <ImfIO.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace images {

/// The bytes of a file as OpenEXR reads them. The bytes must outlive it.
class MemoryInput : public Imf::IStream {
public:
    MemoryInput(const std::string& name, std::string_view bytes) : IStream(name.c_str()), bytes_(bytes)
    {}
    bool read(char data[], int size) override
    {
        const auto count = static_cast<std::size_t>(size);
        if (position_ > bytes_.size() || bytes_.size() - position_ < count)
            throw Iex::InputExc("unexpected end of file");
        std::memcpy(data, bytes_.data() + position_, count);
        position_ += count;
        return position_ < bytes_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override { position_ = position; }

private:
    std::string_view bytes_;
    std::size_t position_ = 0;
};

} // namespace images
