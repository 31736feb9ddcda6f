#include "image/exr_deep.h"

#include <cstring>
#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "base/atomic_file.h"
#include "image/deflate.h"
#include "image/exr_chunk_file.h"
#include "image/naming_file.h"
#include "image/run_packer.h"

namespace burin {
namespace {

/// Compresses bytes as OpenEXR does. Buffers are used again.
class BytePacker {
  public:
    /// The bytes themselves if that does not make them fewer.
    void pack(std::span<const std::uint8_t> raw, ExrCompression compression, std::vector<std::uint8_t>& packed) {
        packed.clear();
        if (compression != ExrCompression::none && !raw.empty()) {
            put_in_order(raw);
            if (compression == ExrCompression::rle) {
                pack_runs(ordered_, packed);
            } else {
                const std::span<const std::uint8_t> stream = deflater_.compress(ordered_);
                if (stream.size() < raw.size()) packed.assign(stream.begin(), stream.end());
            }
        }
        if (packed.empty() || packed.size() >= raw.size()) packed.assign(raw.begin(), raw.end());
    }

  private:
    /// First all bytes of even number and then the others, each as the difference to the byte before, plus 128.
    void put_in_order(std::span<const std::uint8_t> raw) {
        split_.resize(raw.size());
        ordered_.resize(raw.size());
        const std::size_t half = (raw.size() + 1) / 2;
        std::uint8_t *const even = split_.data(), *const odd = split_.data() + half;
        const std::uint8_t* const bytes = raw.data();
        for (std::size_t i = 0, pairs = raw.size() / 2; i < pairs; ++i) {
            even[i] = bytes[2 * i];
            odd[i] = bytes[2 * i + 1];
        }
        if (raw.size() % 2 != 0) even[half - 1] = raw.back();
        const std::uint8_t* const from = split_.data();
        std::uint8_t* const to = ordered_.data();
        to[0] = from[0];
        for (std::size_t i = 1, size = raw.size(); i < size; ++i)
            to[i] = static_cast<std::uint8_t>(from[i] - from[i - 1] + 128);
    }

    Deflater deflater_;
    std::vector<std::uint8_t> split_, ordered_;
};

}  // namespace

/// Rows that are ready before those above them wait, compressed.
class ExrDeepWriter::State {
  public:
    State(const std::string& path, PixelRect display, PixelRect data, const std::vector<ChannelFormat>& channels,
          const ExrOptions& options)
        : path_(path),
          file_(path),
          chunks_(file_, path_),
          end_y_(data.y1),
          next_y_(data.y0),
          compression_(options.compression == ExrCompression::zip ? ExrCompression::zips : options.compression) {
        naming_file(path_, [&] {
            ExrOptions own = options;
            own.compression = compression_;
            chunks_.write_deep_header(display, data, channels, "deep", own);
        });
    }

    void write_rows(int y, std::span<const DeepRow> rows) {
        naming_file(path_, [&] {
            std::unique_ptr<BytePacker> packer = take_packer();
            std::vector<Packed> packed;
            std::vector<std::uint8_t> table;
            for (const DeepRow& row : rows) {
                table.resize(row.counts.size() * sizeof(std::int32_t));
                std::int32_t sum = 0;
                for (std::size_t x = 0; x < row.counts.size(); ++x) {
                    sum += static_cast<std::int32_t>(row.counts[x]);
                    std::memcpy(&table[x * sizeof sum], &sum, sizeof sum);
                }
                Packed& chunk = packed.emplace_back();
                packer->pack(table, compression_, chunk.counts);
                packer->pack(row.samples, compression_, chunk.samples);
                chunk.raw_size = row.samples.size();
            }
            const std::lock_guard lock(mutex_);
            packers_.push_back(std::move(packer));
            waiting_.emplace(y, std::move(packed));
            while (!waiting_.empty() && waiting_.begin()->first == next_y_) {
                for (const Packed& chunk : waiting_.begin()->second)
                    chunks_.write_deep_chunk(next_y_++, chunk.counts, chunk.samples, chunk.raw_size);
                waiting_.erase(waiting_.begin());
            }
        });
    }

    void finish() {
        naming_file(path_, [&] {
            if (next_y_ != end_y_) throw std::logic_error("rows are missing");
            chunks_.finish();
            file_.commit();
        });
    }

  private:
    struct Packed {
        std::vector<std::uint8_t> counts, samples;
        std::uint64_t raw_size = 0;
    };
    std::unique_ptr<BytePacker> take_packer() {
        const std::lock_guard lock(mutex_);
        if (packers_.empty()) return std::make_unique<BytePacker>();
        std::unique_ptr<BytePacker> packer = std::move(packers_.back());
        packers_.pop_back();
        return packer;
    }

    std::string path_;
    AtomicFile file_;
    ExrChunkFile chunks_;
    int end_y_;
    std::mutex mutex_;  // over all that follows
    int next_y_;
    std::map<int, std::vector<Packed>> waiting_;  // by their first row
    std::vector<std::unique_ptr<BytePacker>> packers_;
    ExrCompression compression_;
};

ExrDeepWriter::ExrDeepWriter(const std::string& path, PixelRect display, PixelRect data,
                             const std::vector<ChannelFormat>& channels, const ExrOptions& options)
    : state_(std::make_unique<State>(path, display, data, channels, options)) {}
ExrDeepWriter::~ExrDeepWriter() = default;
void ExrDeepWriter::write_rows(int y, std::span<const DeepRow> rows) { state_->write_rows(y, rows); }
void ExrDeepWriter::finish() { state_->finish(); }

}  // namespace burin
