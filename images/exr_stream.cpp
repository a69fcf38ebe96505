#include "images/exr_stream.h"

#include <Iex.h>

#include <cstring>

namespace images {

MemoryInput::MemoryInput(const std::string& name, std::string_view bytes)
    : IStream(name.c_str()), bytes_(bytes)
{}

bool MemoryInput::read(char data[], int size)
{
    const auto count = static_cast<std::size_t>(size);
    if (position_ > bytes_.size() || bytes_.size() - position_ < count)
        throw Iex::InputExc("unexpected end of file");
    std::memcpy(data, bytes_.data() + position_, count);
    position_ += count;
    return position_ < bytes_.size();
}

std::uint64_t MemoryInput::tellg()
{
    return position_;
}

void MemoryInput::seekg(std::uint64_t position)
{
    position_ = position;
}

} // namespace images
