/// Recovery files: what is in them when, who may have them, and that a program that is killed leaves them whole.

#include "app/recovery.h"
#include "base/file.h"
#include "folder.h"
#include "world.h"
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static void wait_a_moment(void) { nanosleep(&(struct timespec){.tv_nsec = 5000000}, NULL); }

static bool has_file(const struct autosave *autosave) { return access(autosave_path(autosave), F_OK) == 0; }

static struct autosave_work work_of(const struct world *world)
{
    return (struct autosave_work){.document = world->document,
                                  .path = "/home/me/walk.json",
                                  .revision = history_revision(world->history),
                                  .saved = history_is_saved(world->history)};
}

static void update(struct autosave *autosave, const struct world *world, double now)
{
    struct autosave_work work = work_of(world);
    for (int i = 0; i < 4; i++) { // the thread may still be at the last write
        assert_done(autosave_update(autosave, &work, now, &error));
        wait_a_moment();
    }
}

/// Updates until the file is there, or gone: what is due may be refused while the thread is at an earlier write.
static void update_until(struct autosave *autosave, const struct world *world, double now, bool there)
{
    for (int i = 0; i < 3000 && has_file(autosave) != there; i++) update(autosave, world, now);
    assert_int_equal(has_file(autosave), there);
}

static struct autosave *open_autosave(void)
{
    struct recovery_slot slot;
    assert_done(recovery_claim(folder, &slot, &error));
    return autosave_open(&slot);
}

/// The document in the newest file that was left behind, as text.
static char *recovered_text(struct recovery_entry *entry)
{
    assert_true(recovery_find(folder, NULL, entry, NULL));
    struct document *document = document_of_file(entry->slot.path);
    char *text = text_of_document(document);
    document_destroy(document);
    return text;
}

/// Nothing while nothing is unsaved; the first edit at once, later ones a second apart; gone with the save.
TEST_WITH(folder_make, folder_remove, test_when)
{
    struct world world;
    world_open(&world);
    struct autosave *autosave = open_autosave();
    update(autosave, &world, 10);
    wait_a_moment();
    assert_false(has_file(autosave));
    world_must(&world, edit_insert(&world, SWAY, 5, 5));
    update_until(autosave, &world, 10.1, true);
    assert_int_equal(unlink(autosave_path(autosave)), 0); // so that the next write shows
    world_must(&world, edit_insert(&world, SWAY, 6, 5));
    update(autosave, &world, 10.9); // less than a second after the one before
    wait_a_moment();
    assert_false(has_file(autosave));
    update_until(autosave, &world, 11.2, true); // still within two seconds of the edit
    assert_int_equal(unlink(autosave_path(autosave)), 0);
    update(autosave, &world, 20); // nothing new to write
    wait_a_moment();
    assert_false(has_file(autosave));
    world_must(&world, edit_insert(&world, SWAY, 7, 5));
    update_until(autosave, &world, 30, true);
    history_mark_saved(world.history);
    update_until(autosave, &world, 30.1, false);
    autosave_close(autosave, false);
    world_close(&world);
}

/// What is left behind is the document, byte for byte, with its path; it is offered once nobody runs on it any more.
TEST_WITH(folder_make, folder_remove, test_left_behind)
{
    struct world world;
    struct recovery_entry entry;
    world_open(&world);
    struct autosave *autosave = open_autosave();
    world_must(&world, edit_insert(&world, SWAY, 5, 5));
    struct autosave_work work = work_of(&world);
    assert_done(autosave_flush(autosave, &work, &error));
    struct stat about;
    assert_int_equal(stat(autosave_path(autosave), &about), 0);
    assert_int_equal(about.st_mode & 0777, 0600);
    assert_false(recovery_find(folder, NULL, &entry, NULL)); // the running app's own
    autosave_close(autosave, true);
    char *text = recovered_text(&entry);
    assert_document(&world, text);
    assert_string_equal(entry.origin.path, "/home/me/walk.json");
    free(text);
    struct autosave *other = open_autosave(); // claimed by the one that asks: others take a slot of their own
    assert_string_not_equal(autosave_path(other), entry.slot.path);
    autosave_move(other, &entry.slot); // recovered: the file stays until the work is saved
    assert_true(has_file(other));
    history_mark_saved(world.history);
    update_until(other, &world, 1, false);
    autosave_close(other, false);
    assert_false(recovery_find(folder, NULL, &entry, NULL));
    world_close(&world);
}

/// Several left behind: the newest comes first, and the number is told.
TEST_WITH(folder_make, folder_remove, test_newest_first)
{
    struct recovery_slot slots[3];
    struct recovery_entry entry;
    struct error error = {0};
    static const char *const originals[] = {"/a", "/c", "/b"};
    struct document *document = document_create();
    for (int i = 0; i < 3; i++) assert_true(recovery_claim(folder, &slots[i], &error));
    static const int order[] = {0, 2, 1};
    for (int i = 0; i < 3; i++) {
        struct scene_origin origin = {.content = 1};
        strcpy(origin.path, originals[order[i]]);
        assert_true(scene_save_for(document, slots[order[i]].path, &origin, &error));
        nanosleep(&(struct timespec){.tv_nsec = 20000000}, NULL); // the clock of file times is a coarse one
    }
    for (int i = 0; i < 3; i++) recovery_release(&slots[i]);
    static const char *const expected[] = {"/c", "/b", "/a"};
    for (int i = 0, count; i < 3; i++) {
        assert_true(recovery_find(folder, NULL, &entry, &count));
        assert_int_equal(count, 3 - i);
        assert_string_equal(entry.origin.path, expected[i]);
        recovery_remove(&entry.slot);
        recovery_release(&entry.slot);
    }
    document_destroy(document);
}

/// The document's own path comes back whole, up to the longest that the system takes, with whatever a name may hold.
TEST_WITH(folder_make, folder_remove, test_paths)
{
    static const struct {
        size_t length;
        const char *end;
    } paths[] = {{1023, "walk.json"},
                 {1024, "walk.json"},
                 {PATH_LIMIT - 1, "walk.json"},
                 {40, "two\nlines\n"},
                 {PATH_LIMIT - 1, "\n"}};
    struct world world;
    world_open(&world);
    world_must(&world, edit_insert(&world, SWAY, 5, 5));
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        struct autosave *autosave = open_autosave();
        struct recovery_entry entry;
        char path[PATH_LIMIT];
        const size_t length = paths[i].length, rest = strlen(paths[i].end);
        for (size_t k = 0; k < length - rest; k++) path[k] = k % 200 == 0 ? '/' : 'a';
        memcpy(path + length - rest, paths[i].end, rest + 1);
        struct autosave_work work = work_of(&world);
        work.path = path;
        work.content = UINT64_MAX - 7;
        assert_done(autosave_flush(autosave, &work, &error));
        autosave_close(autosave, true);
        assert_true(recovery_find(folder, path, &entry, NULL));
        assert_string_equal(entry.origin.path, path);
        assert_true(entry.origin.content == UINT64_MAX - 7);
        struct document *document = document_of_file(entry.slot.path);
        document_destroy(document);
        recovery_remove(&entry.slot);
        recovery_release(&entry.slot);
    }
    world_close(&world);
}

/// A path of any bytes comes back with the work.
TEST_WITH(folder_make, folder_remove, test_path_that_is_no_text)
{
    struct world world;
    struct recovery_entry entry;
    world_open(&world);
    struct autosave *autosave = open_autosave();
    struct autosave_work work = work_of(&world);
    work.path = "/home/me/\xff.json";
    assert_done(autosave_flush(autosave, &work, &error));
    autosave_close(autosave, true);
    char *text = recovered_text(&entry);
    assert_document(&world, text);
    assert_string_equal(entry.origin.path, work.path);
    free(text);
    recovery_remove(&entry.slot);
    recovery_release(&entry.slot);
    world_close(&world);
}

/// A folder that cannot be written any more is said once, and tried again.
TEST_WITH(folder_make, folder_remove, test_cannot_write)
{
    struct world world;
    struct error error = {0};
    world_open(&world);
    struct autosave *autosave = open_autosave();
    char moved[80];
    snprintf(moved, sizeof moved, "%s.away", folder);
    assert_int_equal(rename(folder, moved), 0);
    world_must(&world, edit_insert(&world, SWAY, 5, 5));
    int complaints = 0;
    for (int i = 0; i < 100; i++) {
        struct autosave_work work = work_of(&world);
        if (!autosave_update(autosave, &work, i, &error)) complaints++;
        wait_a_moment();
    }
    assert_int_equal(complaints, 1);
    assert_non_null(strstr(error.text, folder));
    assert_int_equal(rename(moved, folder), 0);
    update(autosave, &world, 1000);
    wait_a_moment();
    update_until(autosave, &world, 2000, true);
    autosave_close(autosave, false);
    world_close(&world);
}

enum { KILLS = 60 };

/// Saves two documents in turn forever. The larger one takes several writes.
static void save_for_ever(const char *path, struct document *small, struct document *large)
{
    struct error error;
    for (int i = 0;; i++) {
        if (!scene_save(i % 2 ? large : small, path, &error)) _exit(1);
    }
}

/// kill −9 at any moment of a save leaves the old document or the new one, whole.
TEST_WITH(folder_make, folder_remove, test_killed_while_saving)
{
    struct world small, large;
    char path[80];
    world_open(&small);
    world_open(&large);
    world_must(&large, edit_frames(&large, 0, 4000));
    for (int f = 31; f < 4000; f++) world_must(&large, edit_insert(&large, SWAY, f, sin(f)));
    const char *texts[] = {world_print(&small), world_print(&large)};
    snprintf(path, sizeof path, "%s/mine.json", folder);
    assert_done(scene_save(small.document, path, &error));
    srand(7);
    int seen[2] = {0, 0};
    // Until one save was cut short at least; on a loaded machine they take longer.
    for (int i = 0; i < KILLS || !seen[0] || !seen[1]; i++) {
        assert_true(i < 20 * KILLS);
        pid_t child = fork();
        assert_true(child >= 0);
        if (child == 0) save_for_ever(path, small.document, large.document);
        nanosleep(&(struct timespec){.tv_nsec = 1000 * (1000 + rand() % 40000) * (1 + i / KILLS)}, NULL);
        kill(child, SIGKILL);
        int status;
        waitpid(child, &status, 0);
        assert_true(WIFSIGNALED(status));
        char *data;
        size_t size;
        assert_done(file_read(path, 1 << 24, &data, &size, &error));
        bool is_large = strcmp(data, texts[1]) == 0;
        if (!is_large) assert_string_equal(data, texts[0]);
        seen[is_large]++;
        free(data);
    }
    world_close(&small);
    world_close(&large);
}
