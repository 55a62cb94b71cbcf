/// Who may do what with a file that is written anew: the same as before, or less where the system does not let us keep it.
#include "near.h"

#include "base/file.h"
#include "folder.h"
#include <errno.h>
#include <grp.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <sys/xattr.h>
#include <unistd.h>

enum { ME = 1001, SHE = 1002, HE = 1003, OURS = 2001 }; // users, each with a group of that number, and one more group

enum { USER_OBJ = 1, USER = 2, GROUP_OBJ = 4, GROUP = 8, MASK = 16, OTHER = 32, NOBODY = -1 };

/// An ACL as the kernel has it.
struct acl {
    uint32_t version;
    struct {
        uint16_t tag, rights;
        uint32_t id;
    } entries[6];
};

#define ACL(...)                                                                                                     \
    {                                                                                                                \
        2, { {USER_OBJ, 6, (uint32_t)NOBODY}, __VA_ARGS__ }                                                          \
    }

static const struct acl one_named =
    ACL({USER, 6, SHE}, {GROUP_OBJ, 4, (uint32_t)NOBODY}, {MASK, 6, (uint32_t)NOBODY}, {OTHER, 0, (uint32_t)NOBODY});
static const struct acl one_reads =
    ACL({USER, 4, SHE}, {GROUP_OBJ, 6, (uint32_t)NOBODY}, {MASK, 6, (uint32_t)NOBODY}, {OTHER, 6, (uint32_t)NOBODY});
static const struct acl one_locked_out =
    ACL({USER, 0, SHE}, {GROUP_OBJ, 6, (uint32_t)NOBODY}, {MASK, 6, (uint32_t)NOBODY}, {OTHER, 6, (uint32_t)NOBODY});

static const char file_acl[] = "system.posix_acl_access", folder_acl[] = "system.posix_acl_default";

static size_t acl_size(const struct acl *acl)
{
    size_t count = 0;
    while (count < 6 && acl->entries[count].tag) count++;
    return offsetof(struct acl, entries) + count * sizeof acl->entries[0];
}

static const struct {
    const char *what;
    uid_t writer;
    gid_t more; ///< a group that the writer is in besides
    uid_t owner;
    gid_t group;
    mode_t mode;
    const struct acl *acl;
    bool inherits; ///< the folder gives new files an ACL
    uid_t new_owner;
    gid_t new_group;
    mode_t new_mode;
    bool keeps_acl;
} cases[] = {
    {"another group's, root", 0, 0, 0, OURS, 0640, NULL, false, 0, OURS, 0640, false},
    {"another user's, root", 0, 0, ME, OURS, 0664, NULL, false, ME, OURS, 0664, false},
    {"an ACL, root", 0, 0, SHE, OURS, 0660, &one_named, false, SHE, OURS, 0660, true},
    {"an ACL", ME, 0, ME, ME, 0660, &one_named, false, ME, ME, 0660, true},
    {"a group of mine", ME, OURS, ME, OURS, 0660, NULL, false, ME, OURS, 0660, false},
    {"another group's", ME, 0, ME, OURS, 0664, NULL, false, ME, ME, 0644, false},
    {"another group's, closed to others", ME, 0, ME, OURS, 0660, NULL, false, ME, ME, 0600, false},
    {"another group's, which is locked out", ME, 0, ME, OURS, 0606, NULL, false, ME, ME, 0600, false},
    {"another group's, which may read", ME, 0, ME, OURS, 0646, NULL, false, ME, ME, 0644, false},
    {"another user's, by a group", ME, 0, SHE, ME, 0664, NULL, false, ME, ME, 0664, false},
    {"another user's with an ACL, by a group", ME, SHE, SHE, ME, 0666, &one_reads, false, ME, ME, 0666, true},
    {"another group's with an ACL", ME, 0, ME, OURS, 0666, &one_reads, false, ME, ME, 0644, false},
    {"another group's, somebody locked out", ME, 0, ME, OURS, 0666, &one_locked_out, false, ME, ME, 0600, false},
    {"none in a folder with one", ME, 0, ME, ME, 0640, NULL, true, ME, ME, 0640, false},
    {"none in a folder with one, another group's", ME, 0, ME, OURS, 0664, NULL, true, ME, ME, 0644, false},
};

static bool set_acl(const char *path, const char *name, const struct acl *acl)
{
    if (!acl || setxattr(path, name, acl, acl_size(acl), 0) == 0) return true;
    print_message("skip - this file system has no ACLs\n");
    return false;
}

/// Writes a file as another user.
static void write_as(uid_t user, gid_t more, const char *path)
{
    int status;
    const pid_t child = fork();
    if (child == 0) {
        struct error error;
        if (user != 0 && (setgroups(more ? 1 : 0, &more) != 0 || setgid(user) != 0 || setuid(user) != 0)) _exit(2);
        _exit(file_write_atomic(path, "new", 3, &error) ? 0 : 1);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
}

TEST_WITH(folder_make, folder_remove, are_kept_or_fewer)
{
    if (geteuid() != 0) {
        print_message("skip - only root can be several users\n");
        skip();
    }
    assert_int_equal(chmod(folder, 0777), 0);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct acl acl = {0};
        struct stat about;
        char place[80];
        snprintf(place, sizeof place, "%s/%zu", folder, i);
        assert_int_equal(mkdir(place, 0777), 0);
        assert_int_equal(chmod(place, 0777), 0);
        const char *path = strcat(place, "/file");
        FILE *file = fopen(path, "w");
        assert_non_null(file);
        fclose(file);
        assert_int_equal(chown(path, cases[i].owner, cases[i].group), 0);
        assert_int_equal(chmod(path, cases[i].mode), 0);
        if (!set_acl(path, file_acl, cases[i].acl)) continue;
        place[strlen(place) - strlen("/file")] = '\0';
        if (!set_acl(place, folder_acl, cases[i].inherits ? &one_named : NULL)) continue;
        strcat(place, "/file");
        write_as(cases[i].writer, cases[i].more, path);
        assert_int_equal(stat(path, &about), 0);
        const ssize_t size = getxattr(path, file_acl, &acl, sizeof acl);
        const bool right = about.st_size == 3 && about.st_uid == cases[i].new_owner &&
                           about.st_gid == cases[i].new_group && (about.st_mode & 07777) == cases[i].new_mode;
        if (!right)
            fail_msg("%s: now of %u:%u, mode %o", cases[i].what, about.st_uid, about.st_gid, about.st_mode & 07777);
        if (cases[i].keeps_acl)
            assert_memory_equal(&acl, cases[i].acl, acl_size(cases[i].acl));
        else if (size >= 0)
            fail_msg("%s: has an ACL now", cases[i].what);
    }
}

static int known_mask(__attribute__((unused)) void **state)
{
    umask(022);
    return 0;
}
TESTS_BETWEEN(known_mask, NULL)
