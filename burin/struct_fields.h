#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "burin/burin.h"

// Where the fields of the structs of burin.h lie: a struct of an older version ends behind one of them.

namespace burin {

/// A field of a struct, in bytes from the struct's begin.
struct FieldPlace {
    std::size_t begin, end, alignment;
};

/// The fields of a struct of burin.h, in order.
template <typename Struct>
struct Fields;

/// True if the places name every byte of a struct but what fills up to the next field.
template <typename Struct>
constexpr bool names_all_fields() {
    std::size_t end = 0;
    const auto aligned = [&](std::size_t to) { return (end + to - 1) / to * to; };
    for (const FieldPlace& field : Fields<Struct>::places) {
        if (field.begin != aligned(field.alignment)) return false;
        end = field.end;
    }
    return aligned(alignof(Struct)) == sizeof(Struct);
}

/// True if a struct of this size has each field whole or not at all.
template <typename Struct>
constexpr bool ends_between_fields(std::size_t size) {
    for (const FieldPlace& field : Fields<Struct>::places) {
        if (field.begin < size && size < field.end) return false;
    }
    return true;
}

#define BURIN_FIELD(type, name) \
    FieldPlace { offsetof(type, name), offsetof(type, name) + sizeof(type::name), alignof(decltype(type::name)) }

template <>
struct Fields<burin_material> {
    static constexpr std::array places = {BURIN_FIELD(burin_material, size), BURIN_FIELD(burin_material, opacity),
                                          BURIN_FIELD(burin_material, color), BURIN_FIELD(burin_material, name)};
};
static_assert(names_all_fields<burin_material>());

template <>
struct Fields<burin_mesh> {
    static constexpr std::array places = {BURIN_FIELD(burin_mesh, size),
                                          BURIN_FIELD(burin_mesh, name),
                                          BURIN_FIELD(burin_mesh, points),
                                          BURIN_FIELD(burin_mesh, point_count),
                                          BURIN_FIELD(burin_mesh, corners),
                                          BURIN_FIELD(burin_mesh, corner_count),
                                          BURIN_FIELD(burin_mesh, polygon_sizes),
                                          BURIN_FIELD(burin_mesh, polygon_count),
                                          BURIN_FIELD(burin_mesh, polygon_materials),
                                          BURIN_FIELD(burin_mesh, polygon_objects),
                                          BURIN_FIELD(burin_mesh, object_count),
                                          BURIN_FIELD(burin_mesh, object_names),
                                          BURIN_FIELD(burin_mesh, marked_edges),
                                          BURIN_FIELD(burin_mesh, marked_edge_count),
                                          BURIN_FIELD(burin_mesh, corner_uv),
                                          BURIN_FIELD(burin_mesh, point_colors),
                                          BURIN_FIELD(burin_mesh, attribute_names),
                                          BURIN_FIELD(burin_mesh, point_attributes),
                                          BURIN_FIELD(burin_mesh, attribute_count)};
};
static_assert(names_all_fields<burin_mesh>());

template <>
struct Fields<burin_object> {
    static constexpr std::array places = {BURIN_FIELD(burin_object, size), BURIN_FIELD(burin_object, mesh),
                                          BURIN_FIELD(burin_object, material), BURIN_FIELD(burin_object, name),
                                          BURIN_FIELD(burin_object, to_world)};
};
static_assert(names_all_fields<burin_object>());

template <>
struct Fields<burin_view> {
    static constexpr std::array places = {BURIN_FIELD(burin_view, size),    BURIN_FIELD(burin_view, width),
                                          BURIN_FIELD(burin_view, height),  BURIN_FIELD(burin_view, crop),
                                          BURIN_FIELD(burin_view, samples), BURIN_FIELD(burin_view, frame),
                                          BURIN_FIELD(burin_view, camera),  BURIN_FIELD(burin_view, camera_to_world),
                                          BURIN_FIELD(burin_view, fov_deg), BURIN_FIELD(burin_view, ortho_height),
                                          BURIN_FIELD(burin_view, shift),   BURIN_FIELD(burin_view, pixel_aspect)};
};
static_assert(names_all_fields<burin_view>());

template <>
struct Fields<burin_options> {
    static constexpr std::array places = {
        BURIN_FIELD(burin_options, size),         BURIN_FIELD(burin_options, threads),
        BURIN_FIELD(burin_options, memory_bytes), BURIN_FIELD(burin_options, layers),
        BURIN_FIELD(burin_options, progress),     BURIN_FIELD(burin_options, user),
        BURIN_FIELD(burin_options, for_paths),    BURIN_FIELD(burin_options, find_all)};
};
static_assert(names_all_fields<burin_options>());

#undef BURIN_FIELD

}  // namespace burin
