#pragma once
#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "results/moment.hpp"
#include "scene/document.hpp"
#include "scene/expression.hpp"
#include "scene/keys.hpp"
#include "scene/problems.hpp"
#include "scene/scene.hpp"

namespace hibi {

/// A moment that was read. Whether it can come is judged when the whole scene is known.
struct GivenMoment {
    std::string path, label;
    Moment moment;
    bool ends_something = false;  ///< as in Key
    bool is_picture = false;      ///< a picture of an event that cannot happen is left out
};

/// What reading a value needs to know about the scene around it.
struct ReadContext {
    const Scene& scene;  ///< as far as it has been read
    Names names{};
    std::set<std::string> broken_names{};  ///< parameters that could not be read: what uses them stays silent
    std::vector<GivenMoment> moments{};
    Problems problems{};
};

/// One table of the scene, read by the keys of one block. Every reader gives nothing where the key is absent
/// or wrong; what is wrong is told to the problems under path() + "/" + key. The constructor reports unknown
/// keys, keys that are not available yet, and required keys that are missing.
class BlockReader {
 public:
    BlockReader(ReadContext& context, const Value& table, const KeyBlock& block, std::string path,
                std::string title);

    const std::string& path() const { return path_; }
    std::string path(const std::string& key) const { return path_ + "/" + key; }
    const Scene& scene() const { return context_.scene; }
    /// "[run] max_time", for messages.
    std::string label(const std::string& key) const { return title_ + " " + key; }
    bool has(const std::string& key) const { return table_.find(key) != nullptr; }
    bool is_fine(const std::string& key) const { return context_.problems.fine(path(key)); }
    void fail(const std::string& key, const std::string& message, const std::string& hint = {});
    /// Says nothing of a key that follows from another one.
    void silence(const std::string& key) { context_.problems.silence(path(key)); }

    std::optional<std::string> text(const std::string& key);
    std::optional<bool> flag(const std::string& key);
    std::optional<std::int64_t> integer(const std::string& key);
    std::optional<std::string> choice(const std::string& key);
    std::optional<std::vector<std::string>> choices(const std::string& key);
    std::optional<std::vector<std::string>> names(const std::string& key);
    std::optional<double> quantity(const std::string& key);
    /// A quantity that may vary over the position, and over time where `in_time`.
    std::optional<Field> field(const std::string& key, bool in_time);
    /// One entry per axis; an entry "free" is empty, where `may_be_free`.
    std::optional<std::array<std::optional<Field>, 2>> vector(const std::string& key, bool in_time,
                                                              bool may_be_free = false);
    std::optional<Vec<2>> point(const std::string& key);
    std::optional<std::vector<Vec<2>>> points(const std::string& key);
    std::optional<Moment> moment(const std::string& key);
    std::optional<std::vector<Moment>> moments(const std::string& key);
    std::optional<Selection> condition(const std::string& key);
    /// The index of the body that a text names.
    std::optional<int> body(const std::string& key);
    /// [low, high] in `unit`; nothing for "run".
    std::optional<std::array<double, 2>> range(const std::string& key, const std::string& unit);
    std::optional<std::array<int, 2>> size(const std::string& key);
    std::optional<BlockReader> table(const std::string& key);
    std::vector<BlockReader> tables(const std::string& key);

    /// The one key of these that is given. None or several are reported.
    std::optional<std::string> one_of(const std::vector<std::string>& keys, const std::string& what);

 private:
    ReadContext& context_;
    const Value& table_;
    const KeyBlock& block_;
    std::string path_, title_;

    const Value* find(const std::string& key, KeyKind kind) const;
    std::string hint(const std::string& key) const;
    void wrong(const std::string& key, const Value& value, const std::string& sub_path,
               const std::string& wanted);
    /// Reports a number that is outside the range of its key, and gives nothing then.
    std::optional<double> in_range(const std::string& key, std::optional<double> number);
    /// An expression of the given unit. Reports under sub_path.
    std::optional<Expression> expression(const std::string& key, const Value& value,
                                         const std::string& sub_path, const Names& names);
    std::optional<Field> field_of(const std::string& key, const Value& value, const std::string& sub_path,
                                  const std::string& unit, bool in_space, bool in_time);
    std::optional<double> number_of(const std::string& key, const Value& value, const std::string& sub_path,
                                    const std::string& unit);
    std::optional<Moment> moment_of(const std::string& key, const Value& value, const std::string& sub_path);
    std::optional<Vec<2>> point_of(const std::string& key, const Value& value, const std::string& sub_path);
    void check_dimension(const std::string& key, const Value& value, const std::string& sub_path,
                         const Expression& expression, const std::string& unit);
    std::optional<std::vector<std::string>> list_of_texts(const std::string& key, const Value& value);
};

/// Reports an expression's mistake at the characters that are wrong, where the text stands in the file as it
/// is.
void report_expression(ReadContext& context, const std::string& path, const Value& value,
                       const std::string& label, const ExpressionError& error);

}  // namespace hibi
