/// A soft character as a form: its mesh, and two morph targets per coordinate, as in its own file (model/character.h).
#include "export/form.h"
#include "model/vector.h"

/// The character with only the coordinates that the rig uses.
struct moving {
    struct character character;
    struct coordinate coordinates[]; ///< their shapes belong to the figure
};

static bool moves_by(const struct morph *morph, int coordinate)
{
    bool moves = false;
    for (int k = 0; k < morph->count; k++) moves |= morph->coordinate[k] == coordinate;
    return moves;
}

static bool open(const struct posing *posing, int rig, const struct rig_pose *pose, struct form *form,
                 struct error *error)
{
    const struct figure *figure = pose->character.figure;
    const struct character *c = &figure->character;
    (void)posing;
    (void)rig;
    (void)error;
    form->vertex_count = c->vertex_count;
    form->position = (const float(*)[3])c->position;
    form->normal = (const float(*)[3])c->normal;
    form->color = (const float(*)[3])c->color;
    form->indices = c->indices;
    form->index_count = c->index_count;
    struct moving *moving = form->owned =
        pool_take(&form->pool, sizeof *moving + (size_t)c->coordinate_count * sizeof *moving->coordinates, 1);
    form->looks = &c->looks;
    form->targets = pool_take(&form->pool, (size_t)c->coordinate_count * 2, sizeof *form->targets);
    moving->character = *c;
    moving->character.coordinates = moving->coordinates;
    moving->character.coordinate_count = 0;
    form->character = &moving->character;
    for (int k = 0; k < c->coordinate_count; k++) {
        if (!moves_by(&pose->character.morph, k)) continue;
        moving->coordinates[moving->character.coordinate_count++] = c->coordinates[k];
        for (int part = 0; part < 2; part++)
            form->targets[form->target_count++] =
                (struct form_target){figure_target_create(figure, k, part, &form->pool), k};
    }
    return true;
}

/// Places the lowest point of the mesh at rest on the rig's position.
static void stand(const struct rig_pose *pose, float place[3])
{
    for (int k = 0; k < 3; k++)
        place[k] = pose->character.position[k] - (k == 1 ? pose->character.figure->lo[1] : 0.0f);
}

static void key(const struct form *form, const struct rig_pose *pose, struct form_key *key)
{
    const struct morph *morph = &pose->character.morph;
    stand(pose, key->translation);
    for (int t = 0; t < form->target_count; t++) {
        key->weight[t] = 0;
        for (int k = 0; k < morph->count; k++) {
            if (morph->coordinate[k] == form->targets[t].group) key->weight[t] += morph->weight[k][t % 2];
        }
    }
}

static void vertices(const struct form *form, const struct rig_pose *pose, float (*positions)[3])
{
    float place[3];
    stand(pose, place);
    for (int i = 0; i < form->vertex_count; i++) {
        morph_vertex(pose->character.figure, &pose->character.morph, i, positions[i], NULL);
        glm_vec3_add(positions[i], place, positions[i]);
    }
}

/// Each coordinate's weight, a complex number.
static void columns(const struct export_range *range, int rig, const struct rig_pose *pose, double key,
                    form_column *column, void *user)
{
    const char *name = form_name(range->posing->document->rigs[rig]);
    const struct character *c = &pose->character.figure->character;
    const struct morph *morph = &pose->character.morph;
    (void)key;
    for (int k = 0; k < morph->count; k++) {
        const char *coordinate = c->coordinates[morph->coordinate[k]].name;
        column(user, (double)morph->weight[k][0], "%s.%s.re", name, coordinate);
        column(user, (double)morph->weight[k][1], "%s.%s.im", name, coordinate);
    }
}

const struct form_kind character_form = {FORM_MESH | FORM_POINTS, open, key, vertices, columns};
