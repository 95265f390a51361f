#pragma once
#include <string>

#include "record/run_folder.hpp"

namespace hibi {

/// Words for the pictures of one run.
struct Caption {
    std::string text;         ///< what was done and what came of it, figures and program included
    std::string alternative;  ///< the picture, for those who cannot see it
};

/// `description`: counts and materials in one line.
Caption caption_of(const RunSummary& summary, const Topology& topology, const std::string& about,
                   const std::string& description);

/// caption.md: both texts, ready to be copied.
std::string caption_markdown(const Caption& caption, const std::string& title);

/// Figures of the run's folder with their caption, as source for other programs. File names are relative to
/// the folder of the run.
std::string latex_snippet(const Caption& caption, const std::string& label, const std::string& film);
std::string quarto_snippet(const Caption& caption, const std::string& label, const std::string& film);
std::string markdown_snippet(const Caption& caption, const std::string& film);

/// Plain text as LaTeX shows it.
std::string latex_escaped(const std::string& text);

}  // namespace hibi
