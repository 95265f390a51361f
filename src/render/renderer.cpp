#include "render/renderer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string_view>

#include "render/context.hpp"
#include "render/gl.hpp"
#include "render/program.hpp"
#include "results/neighbour_bonds.hpp"

namespace hibi {
namespace {

// llvmpipe clamps point sprites at 255 pixels, and drops one whose centre leaves the viewport: the viewport
// therefore reaches half the largest sprite beyond the picture.
constexpr float largest_sprite = 250;
constexpr float guard = 128;
constexpr float sprite_margin = 2;  ///< of a sprite beyond its disc, both sides together (pixels)

// Spacings (pixels) below which the discs alone cover the body, and below which lines would only grey it:
// bond.vert fades them out towards that.
constexpr double least_surface_spacing = 4;
constexpr double least_line_spacing = 12;

// How much darker than its particles a body is between them, also where a theme has no rims.
constexpr float least_gap = 0.2f;

// What the shaders fetch by index, so that bonds need no positions of their own. The four vertices that draw
// one thing are made from their number alone.
struct DrawnParticle {
    float x, y, half_spacing, value;
};
struct DrawnBond {
    int first, second;
};
struct CrackState {
    float freshness, rest_length;
    float place, unused = 0;  // in the colour map
};

/// A buffer that shaders read as the texture of one unit.
struct Table {
    int unit;
    GLenum format;
    GLuint buffer = 0;
    std::size_t bytes = 0;
};

}  // namespace

struct Renderer::Impl {
    Impl(const View& view, const Topology& body, const RendererOptions& options)
        : width(view.width),
          height(view.height),
          stroke(view.stroke),
          colours(theme(view.theme)),
          topology(body),
          profile(options.profile),
          context(make_context(options.backend)) {
        const CurrentContext current(*context);
        gl.emplace(*context);
        particle.emplace(*gl, "particle", options.shaders);
        surface.emplace(*gl, "surface", options.shaders);
        bond.emplace(*gl, "bond", options.shaders);
        crack.emplace(*gl, "crack", options.shaders);
        make_framebuffer();
        make_colour_map(colour_map(view.map.value_or("inferno")));
        make_tables();
        gl->Enable(GL_PROGRAM_POINT_SIZE);
        gl->Enable(GL_BLEND);
        gl->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
        describe();
        largest_spacing = topology.spacing.empty() ? 0 : *std::ranges::max_element(topology.spacing);
        longest_strip = longest_neighbour_bond(topology);
    }

    void make_framebuffer() {
        GLuint frame = 0, pixels = 0;
        gl->GenFramebuffers(1, &frame);
        gl->GenRenderbuffers(1, &pixels);
        gl->BindFramebuffer(GL_FRAMEBUFFER, frame);
        gl->BindRenderbuffer(GL_RENDERBUFFER, pixels);
        gl->RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
        gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, pixels);
        if (gl->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            throw std::runtime_error(fmt::format("{}: cannot make a picture of {} x {} pixels",
                                                 context->library(), width, height));
    }

    void make_colour_map(const ColourMap& map) {
        GLuint texture = 0;
        gl->GenTextures(1, &texture);
        gl->ActiveTexture(GL_TEXTURE0 + colour_unit);
        gl->BindTexture(GL_TEXTURE_2D, texture);
        gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        gl->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
        gl->TexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, static_cast<GLsizei>(map.size()), 1, 0, GL_RGB,
                       GL_UNSIGNED_BYTE, map.data());
    }

    void make_tables() {
        for (Table* table : {&particle_table, &bond_table, &crack_table, &state_table}) {
            GLuint texture = 0;
            gl->GenBuffers(1, &table->buffer);
            gl->GenTextures(1, &texture);
            gl->BindBuffer(GL_TEXTURE_BUFFER, table->buffer);
            gl->ActiveTexture(GL_TEXTURE0 + table->unit);
            gl->BindTexture(GL_TEXTURE_BUFFER, texture);
            gl->TexBuffer(GL_TEXTURE_BUFFER, table->format, table->buffer);
        }
        GLuint no_attributes = 0;  // a core profile draws nothing without an array object
        gl->GenVertexArrays(1, &no_attributes);
        gl->BindVertexArray(no_attributes);
        gl->GenBuffers(1, &corners);
        gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, corners);
    }

    /// Two triangles each, of the four vertices that the shaders make of their numbers 4 k .. 4 k + 3: none
    /// is worked out twice.
    void draw_quads(int count) {
        if (count > quads) {
            quads = std::max(count, 2 * quads);
            std::vector<GLuint> order_of_corners;
            for (GLuint first = 0; first < 4 * static_cast<GLuint>(quads); first += 4)
                for (const GLuint k : {0u, 1u, 2u, 2u, 1u, 3u}) order_of_corners.push_back(first + k);
            gl->BufferData(GL_ELEMENT_ARRAY_BUFFER,
                           static_cast<GLsizeiptr>(order_of_corners.size() * sizeof(GLuint)),
                           order_of_corners.data(), GL_STATIC_DRAW);
        }
        gl->DrawElements(GL_TRIANGLES, 6 * count, GL_UNSIGNED_INT, nullptr);
    }

    void describe() {
        const auto text = [&](GLenum what) { return reinterpret_cast<const char*>(gl->GetString(what)); };
        const std::string_view version = text(GL_VERSION);
        const auto mesa = version.find("Mesa");
        description = fmt::format("{}, {}, {}", text(GL_RENDERER),
                                  mesa == version.npos ? version : version.substr(mesa), context->library());
    }

    template <class T>
    void upload(Table& table, const std::vector<T>& rows) {
        const std::size_t bytes = rows.size() * sizeof(T);
        gl->BindBuffer(GL_TEXTURE_BUFFER, table.buffer);
        if (bytes == table.bytes)  // fresh memory is dearer than the copy
            gl->BufferSubData(GL_TEXTURE_BUFFER, 0, static_cast<GLsizeiptr>(bytes), rows.data());
        else
            gl->BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(bytes), rows.data(), GL_STREAM_DRAW);
        table.bytes = bytes;
    }

    void start(const Program& program) {
        program.use();
        program.set("picture", static_cast<float>(width), static_cast<float>(height));
        program.set("guard", guard);
        program.set("unit", static_cast<float>(height * stroke / 1080));
        program.set("rim", colours.rim);
        program.set("particles", particle_table.unit);
        program.set("colours", colour_unit);
        program.set("coloured", coloured);
        set(program, "plain", colours.body);
    }
    static void set(const Program& program, const char* uniform, const Rgb& c) {
        program.set(uniform, c[0], c[1], c[2]);
    }

    void upload_particles(const Picture2& picture) {
        const Camera2& camera = picture.camera;
        particles.resize(picture.x.size());
        for (std::size_t i = 0; i < particles.size(); ++i)
            particles[i] = {static_cast<float>(camera.pixel_x(picture.x[i])),
                            static_cast<float>(camera.pixel_y(picture.y[i])),
                            static_cast<float>(topology.spacing[i] * camera.scale / 2),
                            picture.value.empty() ? 0 : picture.value[i]};
        upload(particle_table, particles);
    }

    /// Bonds between neighbours come first: they carry the surface. Most frames show those of the frame
    /// before.
    void upload_bonds(const Picture2& picture) {
        if (picture.intact == uploaded_intact) return;
        uploaded_intact = picture.intact;
        bonds.clear();
        for (const int b : picture.intact) bonds.push_back({topology.first[b], topology.second[b]});
        const auto nearest = [&](const DrawnBond& b) {
            const double length =
                (topology.reference_position[b.second] - topology.reference_position[b.first]).norm();
            return length < longest_strip / 2 * (topology.spacing[b.first] + topology.spacing[b.second]);
        };
        const auto others = std::ranges::stable_partition(bonds, nearest);
        nearest_bonds = static_cast<int>(bonds.size() - others.size());
        upload(bond_table, bonds);
    }

    void upload_cracks(const Picture2& picture) {
        order.resize(picture.broken.size());
        std::iota(order.begin(), order.end(), 0);
        // The flash lies above the traces.
        std::ranges::stable_sort(order, {}, [&](int k) { return picture.freshness[k]; });
        cracks.clear();
        states.clear();
        for (const int k : order) {
            const int b = picture.broken[k];
            cracks.push_back({topology.first[b], topology.second[b]});
            states.push_back({picture.freshness[k],
                              static_cast<float>(topology.rest_length[b] * picture.camera.scale),
                              picture.history.empty() ? 0 : picture.history[k]});
        }
        upload(crack_table, cracks);
        upload(state_table, states);
    }

    void draw(const Picture2& picture, const Rgb& background) {
        gl->Disable(GL_SCISSOR_TEST);
        gl->ClearColor(background[0], background[1], background[2], 1);
        gl->Clear(GL_COLOR_BUFFER_BIT);
        if (picture.x.empty()) return;

        const PixelRect& rect = picture.camera.rect;
        const int left = static_cast<int>(std::floor(rect.x)), top = static_cast<int>(std::floor(rect.y));
        gl->Enable(GL_SCISSOR_TEST);
        gl->Scissor(left, top, static_cast<int>(std::ceil(rect.x + rect.width)) - left,
                    static_cast<int>(std::ceil(rect.y + rect.height)) - top);
        const int beyond = static_cast<int>(guard);
        gl->Viewport(-beyond, -beyond, width + 2 * beyond, height + 2 * beyond);

        const double spacing = largest_spacing * picture.camera.scale;
        const bool with_bonds = !picture.intact.empty() && spacing > least_surface_spacing;
        {
            const TimedStage timed(profile, "upload");
            upload_particles(picture);
            if (with_bonds) upload_bonds(picture);
            if (!picture.broken.empty()) upload_cracks(picture);
        }
        const TimedStage timed(profile, "draw calls");
        coloured = !picture.value.empty();
        if (with_bonds) {
            start(*surface);
            surface->set("bonds", bond_table.unit);
            surface->set("gap", std::max(colours.rim, least_gap));
            draw_quads(nearest_bonds);
        }

        const bool squares = spacing + sprite_margin > largest_sprite;
        const int count = static_cast<int>(particles.size());
        start(*particle);
        particle->set("squares", squares);
        if (squares)
            draw_quads(count);
        else
            gl->DrawArrays(GL_POINTS, 0, count);

        if (with_bonds && spacing > least_line_spacing) {
            start(*bond);
            bond->set("bonds", bond_table.unit);
            set(*bond, "colour", colours.bond);
            draw_quads(static_cast<int>(bonds.size()));
        }
        if (!picture.broken.empty()) {
            start(*crack);
            crack->set("bonds", crack_table.unit);
            crack->set("states", state_table.unit);
            crack->set("by_time", !picture.history.empty());
            set(*crack, "fresh_colour", colours.crack_fresh);
            set(*crack, "old_colour", colours.crack_old);
            set(*crack, "background", colours.background);
            draw_quads(static_cast<int>(cracks.size()));
        }
    }

    int width, height;
    double stroke;
    const Theme& colours;
    const Topology& topology;
    StageTimes* profile;
    double largest_spacing = 0;
    double longest_strip = 0;  ///< of the bonds that carry the surface (spacings)
    bool coloured = true;
    std::string description;
    std::vector<DrawnParticle> particles;
    std::vector<DrawnBond> bonds, cracks;
    std::vector<CrackState> states;
    std::vector<int> order, uploaded_intact;
    GLuint corners = 0;
    int quads = 0;          ///< whose corners the buffer holds
    int nearest_bonds = 0;  ///< the first so many of `bonds`

    // The objects below die with the context, so none is deleted by itself.
    std::unique_ptr<Context> context;
    std::optional<Gl> gl;
    std::optional<Program> particle, surface, bond, crack;
    Table particle_table{0, GL_RGBA32F}, bond_table{1, GL_RG32I}, crack_table{2, GL_RG32I},
        state_table{3, GL_RGBA32F};
    static constexpr int colour_unit = 4;
};

Renderer::Renderer(const View& view, const Topology& topology, const RendererOptions& options)
    : impl_(std::make_unique<Impl>(view, topology, options)) {}
Renderer::~Renderer() = default;

void Renderer::draw(const Picture2& picture, Image& image) {
    draw(picture, impl_->colours.background, image);
}

void Renderer::draw(const Picture2& picture, const Rgb& background, Image& image) {
    assert(picture.x.size() == impl_->topology.spacing.size() && picture.y.size() == picture.x.size());
    assert(picture.value.empty() || picture.value.size() == picture.x.size());
    assert(picture.freshness.size() == picture.broken.size());
    assert(picture.history.empty() || picture.history.size() == picture.broken.size());
    if (image.width != impl_->width || image.height != impl_->height)
        image = Image(impl_->width, impl_->height);
    const CurrentContext current(*impl_->context);
    impl_->draw(picture, background);
    if (impl_->profile) {  // else reading waits for it, and its time cannot be told apart
        const TimedStage timed(impl_->profile, "rasterise");
        impl_->gl->Finish();
    }
    const TimedStage timed(impl_->profile, "read back");
    impl_->gl->ReadPixels(0, 0, image.width, image.height, GL_BGRA, GL_UNSIGNED_BYTE, image.bgra.data());
    if (const GLenum error = impl_->gl->GetError(); error != GL_NO_ERROR)
        throw std::runtime_error(
            fmt::format("{}: drawing failed, OpenGL error {:#06x}", impl_->description, error));
}

bool Renderer::shows_bonds(const Camera2& camera) const {
    return impl_->largest_spacing * camera.scale > least_surface_spacing;
}

std::string Renderer::description() const { return impl_->description; }

}  // namespace hibi
