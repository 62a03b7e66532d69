#pragma once

// A record as a Python class: scalars are attributes, arrays are NumPy views of the record's
// memory, nested records are references into it. A record never moves, so views stay valid with its
// owner.

#include <cstring>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

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

// NumPy view of an array that `owner` keeps alive; the type stub states its element type.
template <class Array>
auto view(Array& array, nb::handle owner) {
    std::vector<size_t> shape;
    extents<Array>::append(shape);
    using scalar = typename extents<Array>::scalar;
    return nb::ndarray<nb::numpy, scalar>(reinterpret_cast<scalar*>(&array), shape.size(),
                                          shape.data(), owner);
}

// Copy values into an array; they may be fewer than its entries.
inline void fill(nb::handle room, nb::handle values) {
    nb::object numpy = nb::module_::import_("numpy");
    nb::object array = numpy.attr("asarray")(values);
    nb::tuple shape = nb::cast<nb::tuple>(array.attr("shape"));
    nb::list part;
    for (nb::handle size : shape) part.append(nb::slice(nb::none(), nb::borrow(size), nb::none()));
    room.attr("__setitem__")(nb::tuple(part), array);
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
        this->def(
            "__copy__", [](const Record& self) { return new Record(self); },
            nb::rv_policy::take_ownership);
        this->def(
            "raw",
            [](nb::handle_t<Record> self) {
                Record* record = nb::inst_ptr<Record>(self);
                size_t size[1] = {sizeof(Record)};
                return nb::ndarray<nb::numpy, std::uint8_t>(reinterpret_cast<std::uint8_t*>(record),
                                                            1, size, self);
            },
            "The memory of the record as bytes.");
    }

    template <class Member>
    record& field(const char* name, Member Record::* member) {
        if constexpr (std::is_class_v<typename extents<Member>::scalar> &&
                      std::is_array_v<Member>) {
            this->def_prop_ro(name, [member](nb::handle_t<Record> self) {
                nb::list parts;
                for (auto& part : nb::inst_ptr<Record>(self)->*member)
                    parts.append(nb::cast(&part, nb::rv_policy::reference_internal, self));
                return nb::borrow<nb::typed<nb::list, typename extents<Member>::scalar>>(parts);
            });
        } else if constexpr (std::is_array_v<Member>) {
            this->def_prop_rw(
                name,
                [member](nb::handle_t<Record> self) {
                    return view(nb::inst_ptr<Record>(self)->*member, self);
                },
                [member](nb::handle_t<Record> self, nb::handle values) {
                    fill(nb::cast(view(nb::inst_ptr<Record>(self)->*member, self),
                                  nb::rv_policy::reference),
                         values);
                });
        } else {
            this->def_rw(name, member);
        }
        return *this;
    }
};

#define FIELD(Record, name) field(#name, &Record::name)

}  // namespace gearbox
