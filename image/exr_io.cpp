#include "image/exr_io.h"

#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <thread>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/interrupt.h"

namespace burin {
namespace {

class AtomicStream : public Imf::OStream {
  public:
    AtomicStream(AtomicFile& file, const std::string& path)
        : Imf::OStream(path.c_str()), file_(file) {}
    void write(const char bytes[], int count) override {
        try {
            file_.write(bytes, static_cast<std::size_t>(count));
        } catch (...) {
            failure_ = std::current_exception();
            throw;
        }
    }
    /// OpenEXR swallows what is thrown while it closes a file.
    void rethrow_failure() const {
        if (failure_) std::rethrow_exception(failure_);
    }
    std::uint64_t tellp() override { return file_.position(); }
    void seekp(std::uint64_t position) override { file_.seek(position); }

  private:
    AtomicFile& file_;
    std::exception_ptr failure_;
};

Imf::PixelType exr_type(PixelType type) {
    switch (type) {
        case PixelType::float16: return Imf::HALF;
        case PixelType::float32: return Imf::FLOAT;
        case PixelType::uint32: return Imf::UINT;
    }
    return Imf::FLOAT;
}

Imath::Box2i box(PixelRect r) { return {{r.x0, r.y0}, {r.x1 - 1, r.y1 - 1}}; }

/// Slices for the rows of the data window that start at `channel.bytes`.
Imf::FrameBuffer frame_buffer(const Image& image) {
    Imf::FrameBuffer buffer;
    for (const Channel& channel : image.channels()) {
        const std::size_t x_stride = size_of(channel.type);
        const std::size_t y_stride = x_stride * static_cast<std::size_t>(image.width());
        const Imath::V2i origin(image.data().x0, image.data().y0);
        char* const base =
            reinterpret_cast<char*>(const_cast<std::byte*>(channel.bytes.data()));
        buffer.insert(channel.name,
                      Imf::Slice::Make(exr_type(channel.type), base, origin, image.width(),
                                       image.height(), x_stride, y_stride));
    }
    return buffer;
}

}  // namespace

void write_exr(const std::string& path, const Image& image, const ExrOptions& options) {
    AtomicFile file(path);
    try {
        const int useful =
            std::min(options.threads, static_cast<int>(std::thread::hardware_concurrency()));
        Imf::setGlobalThreadCount(useful > 1 ? useful : 0);
        Imf::Header header(box(image.display()), box(image.data()));
        header.compression() = Imf::ZIP_COMPRESSION;
        for (const auto& [name, text] : options.texts) {
            header.insert(name, Imf::StringAttribute(text));
        }
        for (const Channel& channel : image.channels()) {
            header.channels().insert(channel.name, Imf::Channel(exr_type(channel.type)));
        }
        AtomicStream stream(file, path);
        {
            Imf::OutputFile output(stream, header);
            output.setFrameBuffer(frame_buffer(image));
            constexpr int kRowsAtOnce =
                256;  // so that an interrupt does not wait for a large image
            for (int row = 0; row < image.height(); row += kRowsAtOnce) {
                throw_if_interrupted();
                output.writePixels(std::min(kRowsAtOnce, image.height() - row));
            }
        }
        stream.rethrow_failure();
    } catch (const InputError&) {
        throw;
    } catch (const Interrupted&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(path + ": cannot write: " + error.what());
    }
    file.commit();
}

Image read_exr(const std::string& path) {
    try {
        Imf::InputFile input(path.c_str());
        const auto rect = [](const Imath::Box2i& b) {
            return PixelRect{b.min.x, b.min.y, b.max.x + 1, b.max.y + 1};
        };
        Image image(rect(input.header().displayWindow()), rect(input.header().dataWindow()));
        const Imf::ChannelList& channels = input.header().channels();
        for (auto it = channels.begin(); it != channels.end(); ++it) {
            const Imf::PixelType type = it.channel().type;
            image.add(it.name(), type == Imf::HALF    ? PixelType::float16
                                 : type == Imf::FLOAT ? PixelType::float32
                                                      : PixelType::uint32);
        }
        input.setFrameBuffer(frame_buffer(image));
        input.readPixels(image.data().y0, image.data().y1 - 1);
        return image;
    } catch (const std::exception& error) {
        throw InputError(path + ": cannot read: " + error.what());
    }
}

}  // namespace burin
