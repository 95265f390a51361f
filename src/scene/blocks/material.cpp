#include "scene/blocks/blocks.hpp"

namespace hibi {

namespace {

Block<Weibull> weibull_keys() {
    Block<Weibull> weibull("weibull", KeyBlock::Form::inner, "Weibull distribution of the bonds' limits.");
    weibull.add("shape", &Weibull::shape, "", "the larger, the less scatter", "12", required, above(0));
    weibull.add("seed", &Weibull::seed, "", "another number, another sample", "7", at_least(0));
    return weibull;
}

/// Rules between the keys of one material.
void check_materials(const Scene& scene, Problems& problems) {
    for (std::size_t k = 0; k < scene.materials.size(); ++k) {
        const Material& m = scene.materials[k];
        const std::string path = fmt::format("material/{}", k), title = fmt::format("[material.{}] ", m.name);
        if (m.break_strain && m.fracture_energy)
            problems.add(path + "/fracture_energy", title + "has both break_strain and fracture_energy",
                         "keep one of them");
        if (m.weibull && !m.can_break() && problems.fine(path))
            problems.add(path + "/weibull", title + "weibull scatters a limit that is not there",
                         "add break_strain or fracture_energy");
    }
}

}  // namespace

SceneBlock material_block() {
    Block<Material> material("material", KeyBlock::Form::named, "A material, by name.");
    material.add("density", &Material::density, "kg/m^3", "mass per volume", R"("2300 kg/m^3")", required,
                 above(0));
    material.add("youngs_modulus", &Material::youngs_modulus, "Pa", "E", R"("210 MPa")", required, above(0));
    material.add("poissons_ratio", &Material::poissons_ratio, "", "nu", "0.3", required, above(-1),
                 below(0.5, "nearly incompressible: 0.49"));
    material.add("break_strain", &Material::break_strain, "",
                 "a bond breaks when its strain exceeds this; absent: it never breaks", "0.1", above(0));
    material.add("fracture_energy", &Material::fracture_energy, "J/m^2",
                 "energy that a unit of crack area costs, in place of break_strain: for bodies with notches",
                 R"("100 J/m^2")", above(0));
    material.add("tension_only", &Material::tension_only, "", "shortened bonds never break", "true");
    material.table(weibull_keys(), &Material::weibull, "random strength: each bond has a limit of its own",
                   "{ shape = 12, seed = 7 }");
    material.keys.required = true;
    SceneBlock result = named_block(material, &Scene::materials);
    result.checks.push_back(check_materials);
    return result;
}

}  // namespace hibi
