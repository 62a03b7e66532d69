#pragma once

// A record as a Python class: scalars are attributes, arrays are NumPy views of the record's
// memory, nested records are references into it. A record never moves, so views stay valid with its
// owner.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include "each.hpp"

namespace gearbox {

namespace nb = nanobind;

template <class Element>
struct extents {
    using scalar = Element;
    static void append(std::vector<size_t>&) {}
};

template <class Element, size_t count>
struct extents<Element[count]> {
    using scalar = typename extents<Element>::scalar;
    static void append(std::vector<size_t>& shape) {
        shape.push_back(count);
        extents<Element>::append(shape);
    }
};

// Copy values into an array; they may be fewer than its entries.
inline void fill(nb::handle room, nb::handle values) {
    nb::object numpy = nb::module_::import_("numpy");
    nb::object array = numpy.attr("asarray")(values);
    nb::tuple shape = nb::cast<nb::tuple>(array.attr("shape"));
    nb::list part;
    for (nb::handle size : shape) part.append(nb::slice(nb::none(), nb::borrow(size), nb::none()));
    room.attr("__setitem__")(nb::tuple(part), array);
}

// Where a field is: `offset` bytes after the start of a record of class `type`. With it, a property
// depends on the type of the field only, so records share the compiled code.
struct FieldPlace {
    nb::handle type;
    size_t offset;

    template <class Field>
    Field* of(nb::handle record) const {
        if (!nb::isinstance(record, type)) throw nb::type_error("not a record of this class");
        return reinterpret_cast<Field*>(nb::inst_ptr<char>(record) + offset);
    }
};

inline void add_property(nb::handle type, const char* name, nb::handle getter, nb::handle setter) {
    nb::handle property(reinterpret_cast<PyObject*>(&PyProperty_Type));
    nb::setattr(type, name, property(getter, setter));
}

template <class Getter>
nb::object getter_of(Getter&& getter) {
    return nb::cpp_function(std::forward<Getter>(getter), nb::is_method(), nb::is_getter(),
                            nb::rv_policy::reference_internal);
}

// The axes of the array may be in another order than in memory: then `strides` is not empty.
template <class Scalar>
void add_array(const char* name, FieldPlace place, const std::vector<size_t>& shape,
               const std::vector<std::int64_t>& strides = {}) {
    // A NumPy view; the type stub states its element type.
    nb::object getter = getter_of([place, shape, strides](nb::handle self) {
        return nb::ndarray<nb::numpy, Scalar>(place.of<Scalar>(self), shape.size(), shape.data(),
                                              self, strides.empty() ? nullptr : strides.data());
    });
    nb::object setter = nb::cpp_function(
        [getter](nb::handle self, nb::handle values) { fill(getter(self), values); },
        nb::is_method());
    add_property(place.type, name, getter, setter);
}

template <class Record>
void add_list(const char* name, FieldPlace place, size_t count) {
    nb::object getter = getter_of([place, count](nb::handle self) {
        Record* first = place.of<Record>(self);
        nb::list parts;
        for (Record* part = first; part < first + count; ++part)
            parts.append(nb::cast(part, nb::rv_policy::reference_internal, self));
        return nb::borrow<nb::typed<nb::list, Record>>(parts);
    });
    add_property(place.type, name, getter, nb::none());
}

template <class Value>
void add_value(const char* name, FieldPlace place) {
    using Given = std::conditional_t<std::is_class_v<Value>, const Value&, Value>;
    add_property(
        place.type, name,
        getter_of([place](nb::handle self) -> const Value& { return *place.of<Value>(self); }),
        nb::cpp_function([place](nb::handle self, Given value) { *place.of<Value>(self) = value; },
                         nb::is_method()));
}

inline auto bytes_of(FieldPlace place, size_t size) {
    return [place, size](nb::handle self) {
        return nb::ndarray<nb::numpy, std::uint8_t>(place.of<std::uint8_t>(self), 1, &size, self);
    };
}

template <class Record>
class record : public nb::class_<Record> {
public:
    record(nb::module_& module, const char* name) : nb::class_<Record>(module, name) {
        this->def("__init__", [](nb::pointer_and_handle<Record> self, nb::kwargs values) {
            std::memset(static_cast<void*>(self.p), 0, sizeof(Record));
            new (self.p) Record{};
            nb::inst_mark_ready(self.h);
            for (auto [key, value] : values) nb::setattr(self.h, key, value);
        });
        // On the heap: some records are larger than the stack of a thread.
        this->def(
            "copy", [](const Record& self) { return new Record(self); },
            nb::rv_policy::take_ownership, "A copy of the record.");
        this->attr("__copy__") = this->attr("copy");
        this->def("raw", bytes_of({*this, 0}, sizeof(Record)),
                  "The memory of the record as bytes.");
    }

    template <class Field>
    record& field(const char* name, size_t offset) {
        using Scalar = typename extents<Field>::scalar;
        FieldPlace place{*this, offset};
        if constexpr (!std::is_array_v<Field>) {
            add_value<Field>(name, place);
        } else if constexpr (std::is_class_v<Scalar>) {
            add_list<Scalar>(name, place, sizeof(Field) / sizeof(Scalar));
        } else {
            std::vector<size_t> shape;
            extents<Field>::append(shape);
            add_array<Scalar>(name, place, shape);
        }
        return *this;
    }

    // A matrix that is stored by columns: an array (height, width) in Python.
    template <class Scalar, size_t width, size_t height>
    record& columns(const char* name, size_t offset, Scalar (Record::*)[width][height]) {
        add_array<Scalar>(name, FieldPlace{*this, offset}, {height, width},
                          {1, static_cast<std::int64_t>(height)});
        return *this;
    }
};

#define COLUMNS(Record, name) columns(#name, offsetof(Record, name), &Record::name)
#define FIELD(Record, name) .field<decltype(Record::name)>(#name, offsetof(Record, name))

// The class of a record with these fields, under its name in C++.
#define RECORD(module, Record, ...) record<Record>(module, #Record) EACH(FIELD, Record, __VA_ARGS__)

// Constants under their names in C++.
#define CONSTANT(module, name) module.attr(#name) = name;
#define CONSTANTS(module, ...) EACH(CONSTANT, module, __VA_ARGS__)

}  // namespace gearbox
