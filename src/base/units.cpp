#include "base/units.hpp"

#include <fmt/format.h>
#include <udunits2.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>
#include <mutex>
#include <stdexcept>
#include <vector>

namespace hibi {

bool Dimension::operator==(const Dimension& other) const {
    for (int i = 0; i < 7; ++i)
        if (std::abs(power[i] - other.power[i]) > 1e-9) return false;
    return true;
}

Dimension operator*(const Dimension& a, const Dimension& b) {
    Dimension r;
    for (int i = 0; i < 7; ++i) r.power[i] = a.power[i] + b.power[i];
    return r;
}
Dimension operator/(const Dimension& a, const Dimension& b) { return a * pow(b, -1); }
Dimension pow(const Dimension& a, double exponent) {
    Dimension r;
    for (int i = 0; i < 7; ++i) r.power[i] = a.power[i] * exponent;
    return r;
}

namespace {

constexpr std::array<const char*, 7> base_symbols{"m", "kg", "s", "A", "K", "mol", "cd"};

struct Taken {
    Quantity unit{1, {}};
    bool proportional = true;  ///< no offset, no logarithm
};

ut_status take_basic(const ut_unit* unit, void* arg) {
    auto& taken = *static_cast<Taken*>(arg);
    const char* symbol = ut_get_symbol(unit, UT_ASCII);
    for (int i = 0; symbol && i < 7; ++i)
        if (std::string(symbol) == base_symbols[i]) taken.unit.dimension.power[i] += 1;
    return UT_SUCCESS;  // the radian is a basic unit, too, and a pure number
}
ut_status take_product(const ut_unit*, int count, const ut_unit* const* units, const int* powers, void* arg) {
    auto& taken = *static_cast<Taken*>(arg);
    for (int i = 0; i < count; ++i) {
        Taken basic;
        take_basic(units[i], &basic);
        taken.unit.dimension = taken.unit.dimension * pow(basic.unit.dimension, powers[i]);
    }
    return UT_SUCCESS;
}
extern const ut_visitor visitor;
ut_status take_galilean(const ut_unit*, double scale, const ut_unit* underlying, double offset, void* arg) {
    auto& taken = *static_cast<Taken*>(arg);
    taken.unit.value *= scale;
    if (offset != 0) taken.proportional = false;
    return ut_accept_visitor(underlying, &visitor, arg);
}
ut_status take_timestamp(const ut_unit*, const ut_unit*, double, void* arg) {
    static_cast<Taken*>(arg)->proportional = false;
    return UT_SUCCESS;
}
ut_status take_logarithmic(const ut_unit*, double, const ut_unit*, void* arg) {
    static_cast<Taken*>(arg)->proportional = false;
    return UT_SUCCESS;
}
const ut_visitor visitor{take_basic, take_product, take_galilean, take_timestamp, take_logarithmic};

std::optional<Quantity> ask_udunits(const std::string& letters) {
    // Both UDUNITS calls below write to the terminal on their own account unless told not to.
    static ut_system* const system = [] {
        ut_set_error_message_handler(ut_ignore);
        ut_system* read = ut_read_xml(nullptr);
        if (!read)
            throw std::runtime_error("the unit table of UDUNITS-2 cannot be read: install libudunits2-data");
        return read;
    }();
    // The one common abbreviation it lacks.
    ut_unit* unit = ut_parse(system, letters == "deg" ? "degree" : letters.c_str(), UT_ASCII);
    if (!unit) return {};
    Taken taken;
    ut_accept_visitor(unit, &visitor, &taken);
    ut_free(unit);
    if (!taken.proportional) return {};
    return taken.unit;
}

}  // namespace

std::optional<Quantity> unit_atom(const std::string& letters) {
    static std::mutex mutex;
    static std::map<std::string, std::optional<Quantity>> known;
    if (letters.empty() || letters.size() > 40) return {};
    // UDUNITS-2 reads far more than unit names (numbers, dates, arithmetic), some of it in surprising ways.
    for (const char c : letters)
        if (!std::isalpha(static_cast<unsigned char>(c))) return {};
    const std::lock_guard lock(mutex);
    const auto found = known.find(letters);
    if (found != known.end()) return found->second;
    const std::optional<Quantity> unit = ask_udunits(letters);
    if (known.size() < 1000) known.emplace(letters, unit);
    return unit;
}

double tidy_factor(double factor) { return std::strtod(fmt::format("{:.14e}", factor).c_str(), nullptr); }

std::optional<Quantity> parse_unit(const std::string& text) {
    Quantity result{1, {}};
    const char* at = text.c_str();
    bool divide = false, want_atom = false, first = true;
    for (;;) {
        while (*at == ' ') ++at;
        if (*at == '\0') {
            if (want_atom) return {};
            result.value = tidy_factor(result.value);
            return result;
        }
        if (*at == '*' || *at == '/') {
            if (want_atom || first) return {};
            divide = *at++ == '/';
            want_atom = true;
            continue;
        }
        std::string letters;
        while (std::isalpha(static_cast<unsigned char>(*at))) letters += *at++;
        std::optional<Quantity> atom = unit_atom(letters);
        if (!atom && first && letters.empty() && *at == '1') {  // "1/s"
            ++at;
            atom = Quantity{1, {}};
        }
        if (!atom) return {};
        double exponent = 1;
        if (*at == '^') {
            char* end = nullptr;
            exponent = std::strtod(++at, &end);
            if (end == at || !(std::abs(exponent) <= 100)) return {};
            at = end;
        }
        if (divide) exponent = -exponent;
        result.value *= std::pow(atom->value, exponent);
        result.dimension = result.dimension * pow(atom->dimension, exponent);
        divide = want_atom = first = false;
    }
}

Dimension dimension_of(const std::string& unit) {
    const auto quantity = parse_unit(unit);
    if (!quantity) throw std::logic_error("no unit: " + unit);
    return quantity->dimension;
}

namespace {

struct Named {
    Dimension dimension;
    const char* name;
    const char* symbol;
};

/// The dimensions that scenes speak of.
const std::vector<Named>& named_dimensions() {
    static const std::vector<Named> list = [] {
        std::vector<Named> named;
        for (const auto& [symbol, name] :
             std::initializer_list<std::pair<const char*, const char*>>{{"", "a plain number"},
                                                                        {"m", "a length"},
                                                                        {"m^2", "an area"},
                                                                        {"m^3", "a volume"},
                                                                        {"s", "a time"},
                                                                        {"1/s", "a rate"},
                                                                        {"kg", "a mass"},
                                                                        {"kg/m^3", "a density"},
                                                                        {"m/s", "a velocity"},
                                                                        {"m/s^2", "an acceleration"},
                                                                        {"N", "a force"},
                                                                        {"N/s", "a force per time"},
                                                                        {"N/m", "a force per length"},
                                                                        {"Pa", "a pressure"},
                                                                        {"Pa/s", "a pressure per time"},
                                                                        {"J", "an energy"},
                                                                        {"J/m^2", "an energy per area"},
                                                                        {"W", "a power"},
                                                                        {"Pa m^0.5", "a stress intensity"},
                                                                        {"K", "a temperature"}})
            named.push_back({dimension_of(symbol), name, symbol});
        return named;
    }();
    return list;
}

std::string base_units(const Dimension& dimension) {
    std::string text;
    for (int i = 0; i < 7; ++i) {
        const double p = dimension.power[i];
        if (std::abs(p) < 1e-9) continue;
        if (!text.empty()) text += ' ';
        text += base_symbols[i];
        if (std::abs(p - 1) > 1e-9) text += fmt::format("^{}", p);
    }
    return text;
}

}  // namespace

std::string dimension_name(const Dimension& dimension) {
    for (const Named& named : named_dimensions())
        if (named.dimension == dimension) return named.name;
    return "in " + base_units(dimension);
}

std::string si_symbol(const Dimension& dimension) {
    for (const Named& named : named_dimensions())
        if (named.dimension == dimension) return named.symbol;
    return base_units(dimension);
}

std::string format_si(double value, const std::string& unit, int digits, bool trim) {
    const std::string behind = unit.empty() ? "" : " " + unit;
    if (!std::isfinite(value)) return fmt::format("{}{}", value, behind);
    if (value == 0) return "0" + behind;
    // Rounded first: 999.96 with three digits is 1.00 k, not 1000.
    value = std::stod(fmt::format("{:.{}e}", value, digits - 1));
    const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12));

    const std::string head = unit.substr(0, unit.find_first_of(" /*"));
    const bool prefixable = head == "m" || head == "s" || head == "N" || head == "Pa" || head == "J" ||
                            head == "W" || head == "Hz" || head == "V" || head == "A" || head == "g";
    int step = 0;
    if (prefixable) {
        const int most = head == "s" ? 0 : head == "m" ? 1 : 5;
        step = std::clamp(static_cast<int>(std::floor(exponent / 3.0)), -5, most);
    }
    constexpr std::array<const char*, 11> prefixes{"f", "p", "n", "µ", "m", "", "k", "M", "G", "T", "P"};
    const double scaled = value / std::pow(10.0, 3 * step);
    const int place = exponent - 3 * step;
    std::string number;
    if (place < -4 || place > std::max(digits + 2, 5)) {
        number = fmt::format("{:.{}e}", scaled, digits - 1);
    } else {
        number = fmt::format("{:.{}f}", scaled, std::max(0, digits - 1 - place));
        if (trim && number.find('.') != std::string::npos) {
            number.erase(number.find_last_not_of('0') + 1);
            if (number.back() == '.') number.pop_back();
        }
    }
    return unit.empty() ? number : number + " " + (prefixable ? prefixes[step + 5] : "") + unit;
}

}  // namespace hibi
