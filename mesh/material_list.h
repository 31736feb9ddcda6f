#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <vector>

// Objects share the list of their model's materials, since there may be very many objects.

namespace burin {

/// The scene's material for each material number of a mesh. Copies share the numbers, so that
/// objects and instances of a model take no memory for its materials.
class MaterialList {
  public:
    MaterialList() = default;
    MaterialList(const std::vector<std::uint32_t>& materials) : MaterialList(materials.data(), materials.size()) {}
    MaterialList(std::initializer_list<std::uint32_t> materials) : MaterialList(materials.begin(), materials.size()) {}
    /// A list with the same material for all of `size` numbers. It takes the memory of one.
    static MaterialList all_alike(std::size_t size, std::uint32_t material) {
        MaterialList list(&material, 1);
        list.mask_ = 0;
        list.size_ = size;
        return list;
    }

    std::uint32_t operator[](std::size_t number) const { return materials_[number & mask_]; }
    std::size_t size() const { return size_; }
    /// Copies have the same one, other lists another.
    const std::uint32_t* address() const { return materials_.get(); }
    /// Calls use(material) for all that are in it, some of them perhaps several times.
    template <typename Use>
    void for_each(const Use& use) const {
        for (std::size_t i = 0; i < (mask_ == 0 ? std::min<std::size_t>(size_, 1) : size_); ++i) use(materials_[i]);
    }

    friend bool operator==(const MaterialList& a, const MaterialList& b) {
        if (a.size_ != b.size_) return false;
        for (std::size_t i = 0; i < a.size_; ++i) {
            if (a[i] != b[i]) return false;
        }
        return true;
    }

  private:
    MaterialList(const std::uint32_t* materials, std::size_t size)
        : materials_(std::make_shared<std::uint32_t[]>(std::max<std::size_t>(size, 1))), size_(size) {
        std::copy(materials, materials + size, materials_.get());
    }

    std::shared_ptr<std::uint32_t[]> materials_;
    std::size_t mask_ = ~std::size_t{0};  // 0: all have the first one
    std::size_t size_ = 0;
};

}  // namespace burin
