/// \file   module.cpp
/// \brief  The Python modules libins.core (double) and libins.coref (float): the C core over NumPy arrays, and its exceptions.
/// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include <cctype>
#include <map>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

namespace libins
{
using namespace nb::literals;

namespace
{
/// Exception classes by status; they live as long as the interpreter, as the module does.
std::map<ins_status_t, PyObject*>& exceptions()
{
    static std::map<ins_status_t, PyObject*> map;
    return map;
}

/// INS_E_RANGE -> RangeError
std::string exception_name(const std::string& status)
{
    std::string name = status.substr(std::string("INS_E_").size());
    std::transform(name.begin() + 1, name.end(), name.begin() + 1,
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return (name == "Abi" ? "ABI" : name) + "Error";
}
} // namespace

[[noreturn]] void raise(ins_status_t status, const std::string& text)
{
    PyErr_SetString(exceptions().at(status), text.c_str());
    throw nb::python_error();
}

void bind_errors(nb::module_& m)
{
    const std::string module = nb::cast<std::string>(m.attr("__name__"));
    const auto add = [&](const std::string& name, const char* doc, const nb::object& bases)
    {
        PyObject* const made = PyErr_NewExceptionWithDoc((module + "." + name).c_str(), doc, bases.ptr(), nullptr);
        if (made == nullptr)
        {
            throw nb::python_error();
        }
        m.attr(name.c_str()) = nb::borrow(made);
        return made;
    };
    const nb::object base = nb::borrow(
        add("Error",
            "The core refused; the message says function, row, and what would be right. The rows before it are done.",
            nb::borrow(PyExc_Exception)));
    const std::map<ins_status_t, PyObject*> builtin = {
        {INS_E_RANGE, PyExc_ValueError}, {INS_E_STATE, PyExc_RuntimeError}, {INS_E_ABI, PyExc_ImportError}};
#define LIBINS_EXCEPTION(name, value, text)                                                                            \
    if ((value) < 0)                                                                                                   \
    {                                                                                                                  \
        const auto also = builtin.find(value);                                                                         \
        exceptions()[value] = add(exception_name(#name), text,                                                         \
                                  also == builtin.end() ? base : nb::make_tuple(base, nb::handle(also->second)));      \
    }
    INS_STATUS_LIST(LIBINS_EXCEPTION)
#undef LIBINS_EXCEPTION
}

} // namespace libins

#define LIBINS_STR_(x) #x
#define LIBINS_STR(x)  LIBINS_STR_(x)

NB_MODULE(LIBINS_MODULE, m)
{
    using namespace libins;
    m.doc() =
        "The core of libins over NumPy arrays, one row a sample. libins.core computes in float64, libins.coref in\n"
        "float32; their names are the same. Names, units and frames are those of the C headers: ins_quat_mul() is\n"
        "quat_mul(), ins_attitude_t is Attitude. docs/python.md says how arrays are taken.";
    if (INS_ABI_CHECK() != INS_OK)
    {
        throw nb::import_error(
            LIBINS_STR(LIBINS_MODULE) ": built with the headers of another libins than it is linked with; rebuild");
    }
    bind_errors(m);
    m.attr("real") =
        nb::module_::import_("numpy").attr("dtype")(sizeof(ins_real) == sizeof(double) ? "float64" : "float32");
    m.def(
        "version",
        [] { return std::make_tuple(ins_version() / 10000, ins_version() / 100 % 100, ins_version() % 100); },
        "Version of the C core: (major, minor, patch).");
    m.def(
        "abi_check",
        [](long version, unsigned real_size)
        {
            Call("abi_check", "version and the size of ins_real as those of this module")
                .check(ins_abi_check(version, real_size));
        },
        "version"_a, "real_size"_a,
        "Raise ABIError unless code for that version (10000 major + 100 minor + patch) and that size of ins_real "
        "[octets] fits this "
        "module. Importing it has checked the module itself.");
    m.def(
        "status_text", [](ins_status_t status) { return std::string(ins_status_text(status)); }, "status"_a,
        "Text of a status code of the C core.");
    m.def("selftest", ins_selftest,
          "Known-answer test of the attitude path: 0, or the SELFTEST_* of what failed, or-ed.");
#define LIBINS_CONSTANT(name) m.attr(#name) = INS_##name;
    LIBINS_CONSTANT(SELFTEST_ABI)
    LIBINS_CONSTANT(SELFTEST_CONING)
    LIBINS_CONSTANT(SELFTEST_STEP)
    LIBINS_CONSTANT(SELFTEST_FITER)
    LIBINS_CONSTANT(SELFTEST_RATES)
    LIBINS_CONSTANT(SELFTEST_FIXED)
    bind_quat(m);
    bind_coning(m);
    bind_attitude(m);
    bind_thesis(m);
    bind_fixed(m);
    bind_navigation(m);
    bind_geodesy(m);
    bind_sensors(m);
    bind_kalman(m);
    bind_kf15(m);
    bind_gps_ins(m);
    bind_gyro_free(m);
    bind_vehicle(m);
    bind_gps_dr(m);
    bind_serial(m);
    bind_packets(m);
    bind_nav_block(m);
}
