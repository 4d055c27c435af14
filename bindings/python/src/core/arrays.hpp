/// \file   arrays.hpp
/// \brief  NumPy arrays in and out of the core's functions, one row a sample, and errors that name function and argument.
///
/// An argument is an array of the very dtype (taken as it is when contiguous, copied when not), or a number, list or tuple, which is
/// converted. An array of another dtype is refused: precision is never lost or invented silently. Compiled once for each ins_real.
/// SPDX-License-Identifier: MIT
#ifndef LIBINS_PY_ARRAYS_HPP
#define LIBINS_PY_ARRAYS_HPP
#include "ins/ins.h"
#include <algorithm>
#include <cstdint>
#include <nanobind/nanobind.h>
#include <string>
#include <type_traits>
#include <vector>

namespace libins
{
namespace nb = nanobind;

/// What Python gave, to be converted by a Call, which knows the argument's name.
struct Given
{
    nb::handle object;
};

using Shape = std::vector<size_t>;
constexpr size_t ANY = SIZE_MAX; ///< a length that the caller of Call::whole() looks at

template <typename T> struct Taken
{
    nb::object keep;
    const T* data = nullptr;
    size_t stride = 0; ///< elements from row to row; 0: one for all rows
    Shape shape;       ///< of the whole array
    const T* operator[](size_t row) const { return data + row * stride; }
};

/// A new array.
template <typename T> struct Made
{
    nb::object array;
    T* data = nullptr;
    size_t stride = 0;
    T* operator[](size_t row) const { return data + row * stride; }
};

template <typename T> Made<T> made(const Shape& shape);
template <typename T> Made<T> copy_of(const T* from, const Shape& shape)
{
    const Made<T> out = made<T>(shape);
    size_t count = 1;
    for (const size_t length : shape)
    {
        count *= length;
    }
    std::copy(from, from + count, out.data);
    return out;
}

inline ins_real as_real(double x)
{
    return static_cast<ins_real>(x);
}

/// Raises the exception of a status. \param[in] text  what was called with what, and what would be right.
[[noreturn]] void raise(ins_status_t status, const std::string& text);
void bind_errors(nb::module_& m);

/// One call from Python: its arguments, its rows, its refusal.
class Call
{
  public:
    /// \param[in] wanted  what the core wants of the arguments, for the message of a refusal.
    explicit Call(const char* function, const char* wanted = "") : function_(function), wanted_(wanted) {}

    /// (shape) or (N, shape); N is the same for all arguments of a call that have it.
    template <typename T> Taken<T> rows(const char* name, const Given& given, const Shape& shape)
    {
        Taken<T> t = take<T>(name, given);
        t.stride = count_rows(name, t.shape, shape);
        return t;
    }
    template <typename T> Taken<T> whole(const char* name, const Given& given, const Shape& shape) const
    {
        Taken<T> t = take<T>(name, given);
        expect_shape(name, t.shape, shape);
        return t;
    }
    /// After all rows(): (shape) or (N, shape).
    template <typename T> Made<T> out(const Shape& shape) const
    {
        Shape all = shape;
        if (many_)
        {
            all.insert(all.begin(), rows_);
        }
        Made<T> m = made<T>(all);
        m.stride = 1;
        for (const size_t length : shape)
        {
            m.stride *= length;
        }
        return m;
    }
    size_t size() const { return rows_; }
    /// Each row in turn, up to the first that is refused, without the interpreter's lock.
    template <typename F> void run(F&& row) const
    {
        size_t k = 0;
        ins_status_t status = INS_OK;
        {
            const nb::gil_scoped_release release;
            for (; k < rows_ && status >= 0; k++)
            {
                if constexpr (std::is_void_v<decltype(row(k))>)
                {
                    row(k);
                }
                else
                {
                    status = row(k);
                }
            }
        }
        if (status < 0)
        {
            refuse(status, many_ ? "row " + std::to_string(k - 1) + ": " : "");
        }
    }
    /// A status of a function that is no row's. \param[in] where  further words for the message.
    void check(ins_status_t status, const std::string& where = "") const
    {
        if (status < 0)
        {
            refuse(status, where);
        }
    }

  private:
    template <typename T> Taken<T> take(const char* name, const Given& given) const;
    size_t count_rows(const char* name, const Shape& got, const Shape& wanted);
    void expect_shape(const char* name, const Shape& got, const Shape& wanted) const;
    [[noreturn]] void refuse(ins_status_t status, const std::string& where) const;

    const char* function_;
    const char* wanted_;
    const char* counted_ = nullptr; ///< argument that said N
    size_t rows_ = 1;
    bool many_ = false;
};

/// A member array, copied out.
template <typename C, typename T, typename E, size_t N>
void reads(nb::class_<C>& c, const char* name, E (T::*member)[N], const Shape& shape, const char* doc)
{
    c.def_prop_ro(
        name, [member, shape](const C& self) { return copy_of<E>(self.*member, shape); }, doc);
}

/// A member array that may be set. \param[in] name  of a literal: it is kept.
template <typename C, typename T, typename E, size_t N>
void writes(nb::class_<C>& c, const char* name, E (T::*member)[N], const Shape& shape, const char* doc)
{
    c.def_prop_rw(
        name, [member, shape](const C& self) { return copy_of<E>(self.*member, shape); },
        [member, shape, name](C& self, const Given& value)
        {
            const auto in = Call("setting").whole<E>(name, value, shape);
            std::copy(in.data, in.data + N, self.*member);
        },
        doc);
}

/// copy.copy() and copy.deepcopy(): a snapshot of the state.
template <typename C> void copies(nb::class_<C>& c)
{
    c.def("__copy__", [](const C& self) { return self; });
    c.def(
        "__deepcopy__", [](const C& self, nb::handle) { return self; }, nb::arg("memo"));
}

void bind_quat(nb::module_& m);
void bind_coning(nb::module_& m);
void bind_attitude(nb::module_& m);
void bind_thesis(nb::module_& m);
void bind_fixed(nb::module_& m);
void bind_navigation(nb::module_& m);
void bind_geodesy(nb::module_& m);
void bind_sensors(nb::module_& m);
void bind_kalman(nb::module_& m);
void bind_kf15(nb::module_& m);
void bind_gps_ins(nb::module_& m);
void bind_gyro_free(nb::module_& m);
void bind_vehicle(nb::module_& m);
void bind_gps_dr(nb::module_& m);
void bind_serial(nb::module_& m);
void bind_packets(nb::module_& m);
void bind_nav_block(nb::module_& m);

template <typename T> constexpr auto element_name()
{
    using nb::detail::const_name;
    if constexpr (std::is_same_v<T, double>)
    {
        return const_name("numpy.float64");
    }
    else if constexpr (std::is_same_v<T, float>)
    {
        return const_name("numpy.float32");
    }
    else if constexpr (std::is_same_v<T, bool>)
    {
        return const_name("numpy.bool_");
    }
    else
    {
        return const_name<std::is_signed_v<T>>("numpy.int", "numpy.uint") + const_name<8 * sizeof(T)>();
    }
}

} // namespace libins

namespace nanobind::detail
{
template <> struct type_caster<libins::Given>
{
    NB_TYPE_CASTER(libins::Given, const_name("numpy.typing.ArrayLike"))
    bool from_python(handle source, uint32_t, cleanup_list*) noexcept
    {
        value.object = source;
        return true;
    }
};

template <typename T> struct type_caster<libins::Made<T>>
{
    NB_TYPE_CASTER(libins::Made<T>, const_name("numpy.typing.NDArray[") + libins::element_name<T>() + const_name("]"))
    static handle from_cpp(const libins::Made<T>& made, rv_policy, cleanup_list*) noexcept
    {
        return object(made.array).release();
    }
};
} // namespace nanobind::detail

#endif // LIBINS_PY_ARRAYS_HPP
