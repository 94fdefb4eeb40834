//! The book of `docs`: it is built, and what it tells people to type is run.

use crate::python::{command, pytest, python, root, run, target};

#[test]
fn the_book_builds_its_notebooks_run_and_so_does_what_its_pages_say() {
    let mut book = command(python());
    // All pages anew, two at a time, notebooks run whatever was kept of them; a warning is an error.
    book.args(["-m", "sphinx", "-W", "--keep-going", "-q", "-a", "-E", "-j", "2"]);
    book.args(["-D", "nb_execution_mode=force", "docs"]).arg(target().0.join("book")).current_dir(root());
    // Most of the time it keeps one core busy.
    std::thread::scope(|scope| {
        scope.spawn(|| run("building the book", &mut book));
        pytest(&root().join("docs/check"));
    });
}
