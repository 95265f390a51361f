#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "scene/block_reader.hpp"
#include "scene/suggest.hpp"

namespace hibi {

namespace {

/// Characters, not bytes, before `bytes`.
int characters_before(const std::string& text, int bytes) {
    int count = 0;
    for (int i = 0; i < bytes && i < static_cast<int>(text.size()); ++i) count += (text[i] & 0xC0) != 0x80;
    return count;
}

/// "a length (m)", "a plain number"
std::string dimension_words(const std::string& unit) {
    const std::string name = dimension_name(dimension_of(unit));
    return unit.empty() ? name : fmt::format("{} ({})", name, unit);
}

bool holds_word(const std::string& text, const std::set<std::string>& words) {
    return std::any_of(words.begin(), words.end(),
                       [&](const std::string& word) { return text.find(word) != std::string::npos; });
}

}  // namespace

void report_expression(ReadContext& context, const std::string& path, const Value& value,
                       const std::string& label, const ExpressionError& error) {
    Place place = value.place;
    if (value.plain_text) {
        place.column += 1 + characters_before(value.text, error.offset);
        place.length = std::max(1, characters_before(value.text.substr(error.offset), error.length));
    }
    context.problems.add(path, place, fmt::format("{}: {}", label, error.what()), error.hint);
}

std::optional<Expression> BlockReader::expression(const std::string& key, const Value& value,
                                                  const std::string& sub_path, const Names& names) {
    try {
        return Expression(value.text, names);
    } catch (const ExpressionError& error) {
        if (holds_word(value.text, context_.broken_names))
            context_.problems.silence(sub_path);
        else
            report_expression(context_, sub_path, value, label(key), error);
        return {};
    }
}

void BlockReader::check_dimension(const std::string& key, const Value& value, const std::string& sub_path,
                                  const Expression& expression, const std::string& unit) {
    const Dimension wanted = dimension_of(unit);
    if (!expression.is_condition() && (expression.dimension() == wanted || expression.is_bare_number()))
        return;
    std::string way_out = hint(key);
    const std::string without_sign = value.text.starts_with("-") ? value.text.substr(1) : value.text;
    if (context_.names.params.contains(without_sign))
        way_out = fmt::format("make \"{}\" in [params] {}", without_sign, dimension_words(unit));
    else if (key == "force" && expression.dimension() == dimension_of("Pa"))
        way_out = fmt::format("for a face load write: pressure = \"{}\"", without_sign);
    else if (key == "pressure" && expression.dimension() == dimension_of("N"))
        way_out = "for a total force write: force = [...]";
    context_.problems.add(
        sub_path, value.place,
        fmt::format("{} needs {}; \"{}\" is {}", label(key), dimension_words(unit), value.text,
                    expression.is_condition() ? "a condition" : dimension_name(expression.dimension())),
        way_out);
}

std::optional<Field> BlockReader::field_of(const std::string& key, const Value& value,
                                           const std::string& sub_path, const std::string& unit,
                                           bool in_space, bool in_time) {
    context_.problems.stands_at(sub_path, value.place);
    if (value.kind == Value::Kind::number || value.kind == Value::Kind::integer) {
        if (std::isfinite(value.number)) return Field(value.number);
        context_.problems.add(sub_path, fmt::format("{} needs a finite number", label(key)), hint(key));
        return {};
    }
    if (value.kind != Value::Kind::text) {
        wrong(key, value, sub_path, dimension_words(unit));
        return {};
    }
    Names names = context_.names;
    names.space = in_space;
    names.time = in_time;
    const auto formula = expression(key, value, sub_path, names);
    if (!formula) return {};
    check_dimension(key, value, sub_path, *formula, unit);
    if (context_.problems.concerns(sub_path)) return {};
    return formula->field();
}

std::optional<double> BlockReader::number_of(const std::string& key, const Value& value,
                                             const std::string& sub_path, const std::string& unit) {
    const auto field = field_of(key, value, sub_path, unit, false, false);
    if (!field) return {};
    return (*field)(Vec3::Zero(), 0);
}

std::optional<double> BlockReader::in_range(const std::string& key, std::optional<double> number) {
    if (!number) return {};
    const Range& range = block_.find(key)->range;
    const Range::End* passed = range.passed_by(*number);
    if (!passed) return number;
    fail(key, fmt::format("{} needs to be {}; found {}", label(key), range.words(), *number), passed->hint);
    return {};
}

std::optional<std::int64_t> BlockReader::integer(const std::string& key) {
    const Value* value = find(key, KeyKind::integer);
    if (!value) return {};
    if (value->kind == Value::Kind::integer)
        return in_range(key, value->number) ? std::optional(value->integer) : std::nullopt;
    if (value->kind != Value::Kind::text) {
        wrong(key, *value, path(key), "a whole number");
        return {};
    }
    const auto number = number_of(key, *value, path(key), "");
    if (!number) return {};
    constexpr double exact = 9007199254740992;  // 2^53: beyond it a double skips whole numbers
    if (*number != std::round(*number) || std::abs(*number) > exact) {
        context_.problems.add(path(key), value->place,
                              fmt::format("{} needs a whole number; found {}", label(key), *number),
                              hint(key));
        return {};
    }
    if (!in_range(key, number)) return {};
    return static_cast<std::int64_t>(*number);
}

std::optional<double> BlockReader::quantity(const std::string& key) {
    const Value* value = find(key, KeyKind::quantity);
    if (!value) return {};
    return in_range(key, number_of(key, *value, path(key), block_.find(key)->unit));
}

std::optional<Field> BlockReader::field(const std::string& key, bool in_time) {
    const Value* value = find(key, KeyKind::quantity);
    if (!value) return {};
    return field_of(key, *value, path(key), block_.find(key)->unit, true, in_time);
}

std::optional<std::array<std::optional<Field>, 2>> BlockReader::vector(const std::string& key, bool in_time,
                                                                       bool may_be_free) {
    const Value* value = find(key, KeyKind::vector);
    if (!value) return {};
    const Key& known = *block_.find(key);
    const std::string wanted = fmt::format("a list of 2 entries, one per axis ({})", known.unit);
    if (value->kind != Value::Kind::array) {
        wrong(key, *value, path(key), wanted);
        return {};
    }
    if (value->items.size() != 2) {
        context_.problems.add(path(key), value->place,
                              fmt::format("{} needs {}; found {}", label(key), wanted, value->items.size()),
                              hint(key));
        return {};
    }
    std::array<std::optional<Field>, 2> result;
    for (int axis = 0; axis < 2; ++axis) {
        const Value& item = value->items[axis];
        if (may_be_free && item.kind == Value::Kind::text && item.text == "free") continue;
        result[axis] =
            field_of(key, item, fmt::format("{}/{}", path(key), axis), known.unit, known.varies, in_time);
    }
    if (context_.problems.concerns(path(key))) return {};
    return result;
}

std::optional<Vec<2>> BlockReader::point_of(const std::string& key, const Value& value,
                                            const std::string& sub_path) {
    context_.problems.stands_at(sub_path, value.place);
    if (value.kind != Value::Kind::array || value.items.size() != 2) {
        context_.problems.add(sub_path, value.place, fmt::format("{} needs points [x, y]", label(key)),
                              hint(key));
        return {};
    }
    const auto x = number_of(key, value.items[0], sub_path + "/0", block_.find(key)->unit);
    const auto y = number_of(key, value.items[1], sub_path + "/1", block_.find(key)->unit);
    if (!x || !y) return {};
    return Vec<2>(*x, *y);
}

std::optional<Vec<2>> BlockReader::point(const std::string& key) {
    const Value* value = find(key, KeyKind::point);
    if (!value) return {};
    return point_of(key, *value, path(key));
}

std::optional<std::vector<Vec<2>>> BlockReader::points(const std::string& key) {
    const Value* value = find(key, KeyKind::points);
    if (!value) return {};
    if (value->kind != Value::Kind::array) {
        wrong(key, *value, path(key), "a list of points [x, y]");
        return {};
    }
    std::vector<Vec<2>> points;
    for (std::size_t i = 0; i < value->items.size(); ++i)
        if (const auto point = point_of(key, value->items[i], fmt::format("{}/{}", path(key), i)))
            points.push_back(*point);
    if (context_.problems.concerns(path(key))) return {};
    return points;
}

std::optional<Moment> BlockReader::moment(const std::string& key) {
    const Value* value = find(key, KeyKind::moment);
    const auto moment = value ? moment_of(key, *value, path(key)) : std::nullopt;
    if (moment)
        context_.moments.push_back({path(key), label(key), *moment, block_.find(key)->ends_something, false});
    return moment;
}

std::optional<std::vector<Moment>> BlockReader::moments(const std::string& key) {
    const Value* value = find(key, KeyKind::moments);
    if (!value) return {};
    if (value->kind != Value::Kind::array || value->items.empty()) {
        wrong(key, *value, path(key), "a list of events or times");
        return {};
    }
    std::vector<Moment> moments;
    for (std::size_t i = 0; i < value->items.size(); ++i) {
        const std::string sub_path = fmt::format("{}/{}", path(key), i);
        context_.problems.stands_at(sub_path, value->items[i].place);
        if (const auto moment = moment_of(key, value->items[i], sub_path)) {
            moments.push_back(*moment);
            context_.moments.push_back({sub_path, label(key), *moment, false, true});
        }
    }
    if (context_.problems.concerns(path(key))) return {};
    return moments;
}

std::optional<Moment> BlockReader::moment_of(const std::string& key, const Value& value,
                                             const std::string& sub_path) {
    if (value.kind == Value::Kind::number || value.kind == Value::Kind::integer) {
        if (const auto time = number_of(key, value, sub_path, "s")) return Moment{{}, *time};
        return {};
    }
    const std::string wanted = "an event or a time";
    if (value.kind != Value::Kind::text) {
        wrong(key, value, sub_path, wanted);
        return {};
    }
    // The event is taken off the front; what is left is a time with a sign.
    const std::string& text = value.text;
    const std::size_t begin = std::min(text.find_first_not_of(' '), text.size());
    std::size_t end = begin;
    while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_'))
        ++end;
    const std::string word = text.substr(begin, end - begin);
    Moment moment;
    moment.event = event_from(word);
    const bool is_name = !word.empty() && !std::isdigit(static_cast<unsigned char>(word[0]));
    if (is_name && !moment.event && !context_.names.params.count(word) && !is_reserved_name(word)) {
        if (context_.broken_names.count(word)) {
            context_.problems.silence(sub_path);
            return {};
        }
        std::vector<std::string> known{"start", "first_break", "peak_load", "separation", "end"};
        const auto near = nearest(word, known);
        Place place = value.place;
        if (value.plain_text) {
            place.column += 1 + static_cast<int>(begin);
            place.length = static_cast<int>(word.size());
        }
        context_.problems.add(
            sub_path, place, fmt::format("{}: unknown event \"{}\"", label(key), word),
            near ? fmt::format("did you mean \"{}\"?", *near) : "events: " + list_of(known));
        return {};
    }
    Value rest = value;
    if (moment.event) {
        const std::size_t sign = std::min(text.find_first_not_of(' ', end), text.size());
        if (sign == text.size()) return moment;
        if (text[sign] != '+' && text[sign] != '-') {
            wrong(key, value, sub_path, "an event, then perhaps + or - a time");
            return {};
        }
        // Blanks keep the offsets, and so the places, of what follows.
        rest.text = std::string(end, ' ') + text.substr(end);
    }
    const auto formula = expression(key, rest, sub_path, context_.names);
    if (!formula) return {};
    if (!(formula->dimension() == dimension_of("s")) && !formula->is_bare_number()) {
        check_dimension(key, value, sub_path, *formula, "s");
        return {};
    }
    moment.offset = (*formula)(Vec3::Zero(), 0);
    return moment;
}

std::optional<Selection> BlockReader::condition(const std::string& key) {
    const Value* value = find(key, KeyKind::condition);
    if (!value) return {};
    if (value->kind != Value::Kind::text) {
        wrong(key, *value, path(key), "a condition in quotes");
        return {};
    }
    Names names = context_.names;
    names.space = true;
    const auto formula = expression(key, *value, path(key), names);
    if (!formula) return {};
    if (!formula->is_condition()) {
        wrong(key, *value, path(key), "a condition");
        return {};
    }
    Selection selection;
    selection.text = formula->text();
    selection.condition = [formula = *formula](const Vec3& X, double slack) {
        return formula.holds(X, slack);
    };
    return selection;
}

std::optional<std::array<double, 2>> BlockReader::range(const std::string& key, const std::string& unit) {
    const Value* value = find(key, KeyKind::range);
    if (!value || (value->kind == Value::Kind::text && value->text == "run")) return {};
    if (value->kind != Value::Kind::array || value->items.size() != 2) {
        wrong(key, *value, path(key), "\"run\" or [low, high]");
        return {};
    }
    const auto low = number_of(key, value->items[0], path(key) + "/0", unit);
    const auto high = number_of(key, value->items[1], path(key) + "/1", unit);
    if (!low || !high) return {};
    if (!(*low < *high)) {
        fail(key, fmt::format("{}: the low end is not below the high end", label(key)));
        return {};
    }
    return std::array{*low, *high};
}

}  // namespace hibi
