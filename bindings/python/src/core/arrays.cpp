/// \file   arrays.cpp
/// \brief  See arrays.hpp. SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>

namespace libins
{
namespace
{

template <typename T> using Contiguous = nb::ndarray<const T, nb::c_contig, nb::device::cpu>;

template <typename T> const char* dtype_name()
{
    static const char text[] = "numpy.";
    static const std::string name = std::string(element_name<T>().text).substr(sizeof text - 1);
    return name.c_str();
}

std::string text_of(const Shape& shape)
{
    std::string text = "(";
    for (const size_t length : shape)
    {
        text += (length == ANY ? std::string("any") : std::to_string(length)) + (shape.size() == 1 ? "," : ", ");
    }
    if (shape.size() > 1)
    {
        text.resize(text.size() - 2);
    }
    return text + ")";
}

std::string text_of(const nb::object& object)
{
    return nb::str(object).c_str();
}

/// A number, list or tuple as an array of T. Only whole numbers become whole numbers, only truths truths.
template <typename T> nb::object converted(const std::string& place, nb::handle object)
{
    const nb::module_ numpy = nb::module_::import_("numpy");
    const auto refuse = [&](const std::string& found)
    {
        const std::string text = place + ": found " + found + ", wanted an array of dtype " + dtype_name<T>() +
                                 ", or numbers in lists or tuples";
        throw nb::type_error(text.c_str());
    };
    nb::object array;
    try
    {
        array = numpy.attr("asarray")(object);
    }
    catch (const nb::python_error&)
    {
        refuse("rows of different lengths, or no numbers");
    }
    const std::string kind = nb::cast<std::string>(array.attr("dtype").attr("kind"));
    const bool empty = nb::cast<size_t>(array.attr("size")) == 0;
    const char* const kinds = std::is_same_v<T, bool> ? "b" : std::is_integral_v<T> ? "iu" : "iuf";
    if (!empty && std::string(kinds).find(kind) == std::string::npos)
    {
        refuse(text_of(array.attr("dtype")));
    }
    try
    {
        return numpy.attr("asarray")(empty ? array : nb::borrow(object), dtype_name<T>(), nb::arg("order") = "C");
    }
    catch (const nb::python_error&)
    {
        refuse("a number that does not fit");
    }
    return array;
}

} // namespace

template <typename T> Made<T> made(const Shape& shape)
{
    size_t count = 1;
    for (const size_t length : shape)
    {
        count *= length;
    }
    T* const data = new T[std::max<size_t>(count, 1)];
    const nb::capsule owner(data, [](void* p) noexcept { delete[] static_cast<T*>(p); });
    Made<T> out;
    out.array = nb::cast(nb::ndarray<nb::numpy, T>(data, shape.size(), shape.data(), owner));
    out.data = data;
    return out;
}

template <typename T> Taken<T> Call::take(const char* name, const Given& given) const
{
    const std::string place = std::string(function_) + ": " + name;
    Taken<T> taken;
    taken.keep = nb::borrow(given.object);
    Contiguous<T> array;
    if (!nb::try_cast(taken.keep, array, false))
    {
        const nb::module_ numpy = nb::module_::import_("numpy");
        if (nb::ndarray_check(given.object) && !nb::isinstance(given.object, numpy.attr("generic")))
        {
            nb::ndarray<nb::ro, nb::device::cpu> any;
            if (!nb::try_cast(taken.keep, any, false) || any.dtype() != nb::dtype<T>())
            {
                const std::string found = text_of(nb::getattr(taken.keep, "dtype", nb::none()));
                const std::string text = place + ": found an array of dtype " + found + ", wanted " + dtype_name<T>() +
                                         ": convert it with .astype(\"" + dtype_name<T>() + "\")";
                throw nb::type_error(text.c_str());
            }
            taken.keep = numpy.attr("ascontiguousarray")(taken.keep);
        }
        else
        {
            taken.keep = converted<T>(place, given.object);
        }
        array = nb::cast<Contiguous<T>>(taken.keep);
    }
    taken.data = array.data();
    for (size_t i = 0; i < array.ndim(); i++)
    {
        taken.shape.push_back(array.shape(i));
    }
    return taken;
}

size_t Call::count_rows(const char* name, const Shape& got, const Shape& wanted)
{
    size_t width = 1;
    for (const size_t length : wanted)
    {
        width *= length;
    }
    if (got == wanted)
    {
        return 0;
    }
    if (got.size() != wanted.size() + 1 || !std::equal(wanted.begin(), wanted.end(), got.begin() + 1))
    {
        std::string rows = text_of(wanted);
        rows = wanted.empty() ? "(N,)" : "(N, " + rows.substr(1, rows.size() - (wanted.size() == 1 ? 3 : 2)) + ")";
        const std::string text = std::string(function_) + ": " + name + ": found shape " + text_of(got) + ", wanted " +
                                 text_of(wanted) + " or " + rows;
        throw nb::value_error(text.c_str());
    }
    if (counted_ != nullptr && rows_ != got[0])
    {
        const std::string text = std::string(function_) + ": " + name + ": found " + std::to_string(got[0]) +
                                 " rows, wanted " + std::to_string(rows_) + " as in " + counted_;
        throw nb::value_error(text.c_str());
    }
    counted_ = name;
    rows_ = got[0];
    many_ = true;
    return width;
}

void Call::expect_shape(const char* name, const Shape& got, const Shape& wanted) const
{
    const auto same = [](size_t have, size_t want) { return want == ANY || have == want; };
    if (got.size() != wanted.size() || !std::equal(got.begin(), got.end(), wanted.begin(), same))
    {
        const std::string text =
            std::string(function_) + ": " + name + ": found shape " + text_of(got) + ", wanted " + text_of(wanted);
        throw nb::value_error(text.c_str());
    }
}

void Call::refuse(ins_status_t status, const std::string& where) const
{
    const std::string wanted = *wanted_ != '\0' ? std::string("; wanted: ") + wanted_ : std::string();
    raise(status, std::string(function_) + ": " + where + ins_status_text(status) + wanted);
}

#define LIBINS_ELEMENT(T)                                                                                              \
    template Made<T> made(const Shape&);                                                                               \
    template Taken<T> Call::take(const char*, const Given&) const;
LIBINS_ELEMENT(ins_real)
LIBINS_ELEMENT(bool)
LIBINS_ELEMENT(uint8_t)
LIBINS_ELEMENT(uint16_t)
LIBINS_ELEMENT(int32_t)
LIBINS_ELEMENT(uint32_t)
LIBINS_ELEMENT(int64_t)
#ifdef INS_REAL_FLOAT
LIBINS_ELEMENT(double)
#endif

} // namespace libins
