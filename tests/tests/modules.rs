//! What modules name of one another: of those that stand beside one another none names what lies in a second one that
//! leads back to it. A module and what lies inside it may name each other.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use quote::ToTokens;
use syn::{Attribute, Item, UseTree};

use super::root;

/// Names of modules from the crate's root, or of a path.
type Names = Vec<String>;

/// What a module says, without what is only compiled for tests.
#[derive(Default)]
struct Module {
    children: BTreeSet<String>,
    defined: BTreeSet<String>,
    /// What `use` names here, by the name that it has here.
    imported: BTreeMap<String, Names>,
    /// Modules of which `use` names everything.
    globs: Vec<Names>,
    /// All paths of more than one name.
    paths: Vec<Names>,
}

/// The modules of a crate.
#[derive(Default)]
struct Modules(BTreeMap<Names, Module>);

impl Modules {
    fn of_crate(source: &Path) -> Self {
        let mut modules = Self::default();
        modules.read(file(&source.join("lib.rs")), source, &[]);
        modules
    }

    fn read(&mut self, items: Vec<Item>, folder: &Path, name: &[String]) {
        let mut module = Module::default();
        for item in items {
            if is_for_tests(&item) {
                continue;
            }
            match item {
                Item::Mod(child) => {
                    let name: Names = [name, &[child.ident.to_string()]].concat();
                    let below = folder.join(&name[name.len() - 1]);
                    let items = match child.content {
                        Some((_, items)) => items,
                        None if below.is_dir() => file(&below.join("mod.rs")),
                        None => file(&below.with_extension("rs")),
                    };
                    module.children.extend(name.last().cloned());
                    self.read(items, &below, &name);
                }
                Item::Use(statement) => {
                    named_by_use(&statement.tree, &[], &mut |own, path| {
                        match own {
                            Some(own) => drop(module.imported.insert(own, path.clone())),
                            None => module.globs.push(path.clone()),
                        }
                        module.paths.push(path);
                    });
                }
                other => {
                    module.defined.extend(defined(&other));
                    named_by_code(other.to_token_stream(), &mut module.paths);
                }
            }
        }
        self.0.insert(name.to_vec(), module);
    }

    /// The module in which that lies which a path means that stands in a module; none for other crates.
    fn target(&self, path: &[String], module: &[String], depth: usize) -> Option<Names> {
        // Names that are those of themselves.
        if depth == 20 {
            return None;
        }
        let here = &self.0[module];
        let mut at = module.to_vec();
        let mut rest = path;
        match path[0].as_str() {
            "crate" => (at, rest) = (Vec::new(), &path[1..]),
            "self" => rest = &path[1..],
            "super" => {}
            child if here.children.contains(child) => {}
            own => {
                let meant = here.imported.get(own).filter(|meant| meant[0] != own)?;
                return self.target(&[meant, &path[1..]].concat(), module, depth + 1);
            }
        }
        while rest.first().is_some_and(|name| name == "super") {
            at.pop();
            rest = &rest[1..];
        }
        while let Some(child) = rest.first()
            && self.0[&at].children.contains(child)
        {
            at.push(child.clone());
            rest = &rest[1..];
        }
        let Some(name) = rest.first() else {
            return Some(at);
        };
        let there = &self.0[&at];
        if there.defined.contains(name) {
            return Some(at);
        }
        if let Some(meant) = there.imported.get(name) {
            return self.target(&[meant, &rest[1..]].concat(), &at, depth + 1);
        }
        let by_glob = there.globs.iter().find_map(|glob| {
            let found = self.target(&[glob, rest].concat(), &at, depth + 1)?;
            (found != at).then_some(found)
        });
        by_glob.or(Some(at))
    }

    /// What every module names that lies in another one: the module, the other one, and the path.
    fn named(&self) -> impl Iterator<Item = (&Names, Names, &Names)> {
        self.0.iter().flat_map(move |(module, content)| {
            let paths = content.paths.iter();
            paths.filter_map(move |path| Some((module, self.target(path, module, 0)?, path)))
        })
    }

    /// Circles of modules with the same parent, each with what ties it.
    fn circles(&self) -> Vec<String> {
        let mut arrows: BTreeMap<Names, BTreeMap<Names, BTreeSet<String>>> = BTreeMap::new();
        for (module, target, path) in self.named() {
            if target.starts_with(module) || module.starts_with(&target) {
                continue;
            }
            let both = module.iter().zip(&target);
            let beside = 1 + both.take_while(|(a, b)| a == b).count();
            let why = format!("{} names {}", module.join("::"), path.join("::"));
            let from = arrows.entry(module[..beside].to_vec()).or_default();
            from.entry(target[..beside].to_vec())
                .or_default()
                .insert(why);
        }
        let reached = |from: &Names| {
            let mut reached = BTreeSet::new();
            let mut open = vec![from];
            while let Some(next) = open.pop() {
                let next = arrows.get(next).into_iter().flat_map(BTreeMap::keys);
                open.extend(next.filter(|to| reached.insert((*to).clone())));
            }
            reached
        };
        let reached: BTreeMap<&Names, BTreeSet<Names>> =
            arrows.keys().map(|from| (from, reached(from))).collect();
        let mut circles = BTreeMap::new();
        for (from, all) in &reached {
            let back = |to: &&Names| reached.get(to).is_some_and(|all| all.contains(*from));
            let circle: BTreeSet<&Names> = all.iter().filter(back).collect();
            for to in arrows[*from].keys().filter(|to| circle.contains(to)) {
                let ties: &mut BTreeSet<&String> = circles.entry(circle.clone()).or_default();
                ties.extend(&arrows[*from][to]);
            }
        }
        circles
            .into_iter()
            .map(|(circle, ties)| {
                let names: Vec<String> = circle.iter().map(|names| names.join("::")).collect();
                let ties: Vec<&str> = ties.iter().map(|tie| tie.as_str()).collect();
                format!("{}:\n  {}", names.join(", "), ties.join("\n  "))
            })
            .collect()
    }
}

fn file(path: &Path) -> Vec<Item> {
    let text = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    syn::parse_file(&text).unwrap().items
}

fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}

fn is_for_tests(item: &Item) -> bool {
    attributes(item).iter().any(|attribute| {
        attribute.path().is_ident("cfg")
            && attribute
                .meta
                .to_token_stream()
                .to_string()
                .contains("test")
    })
}

/// The name of an item that has one.
fn defined(item: &Item) -> Option<String> {
    let name = match item {
        Item::Const(item) => &item.ident,
        Item::Enum(item) => &item.ident,
        Item::Fn(item) => &item.sig.ident,
        Item::Macro(item) => item.ident.as_ref()?,
        Item::Static(item) => &item.ident,
        Item::Struct(item) => &item.ident,
        Item::Trait(item) => &item.ident,
        Item::Type(item) => &item.ident,
        _ => return None,
    };
    Some(name.to_string())
}

/// Tells of every name of a `use` how it is called where it stands, none for all of a module, and its path.
fn named_by_use(tree: &UseTree, before: &[String], told: &mut impl FnMut(Option<String>, Names)) {
    let with = |name: &syn::Ident| [before, &[name.to_string()]].concat();
    match tree {
        UseTree::Path(path) => named_by_use(&path.tree, &with(&path.ident), told),
        UseTree::Name(name) if name.ident == "self" => {
            told(before.last().cloned(), before.to_vec());
        }
        UseTree::Name(name) => told(Some(name.ident.to_string()), with(&name.ident)),
        UseTree::Rename(name) if name.ident == "self" => {
            told(Some(name.rename.to_string()), before.to_vec());
        }
        UseTree::Rename(name) => told(Some(name.rename.to_string()), with(&name.ident)),
        UseTree::Glob(_) => told(None, before.to_vec()),
        UseTree::Group(group) => {
            for tree in &group.items {
                named_by_use(tree, before, told);
            }
        }
    }
}

/// Paths of more than one name in code, also in that of macros.
fn named_by_code(code: TokenStream, paths: &mut Vec<Names>) {
    let tokens: Vec<TokenTree> = code.into_iter().collect();
    let colons = |at: usize| {
        let colon =
            |at: usize| matches!(tokens.get(at), Some(TokenTree::Punct(p)) if p.as_char() == ':');
        colon(at) && colon(at + 1)
    };
    let mut at = 0;
    while at < tokens.len() {
        match &tokens[at] {
            TokenTree::Group(group) => named_by_code(group.stream(), paths),
            // `<T as Trait>::name` and `Vec::<T>::new` go on in what is no path from a module.
            TokenTree::Ident(first) if at < 2 || !colons(at - 2) => {
                let mut path = vec![first.to_string()];
                let mut group = None;
                while colons(at + 1) {
                    match tokens.get(at + 3) {
                        Some(TokenTree::Ident(name)) => path.push(name.to_string()),
                        Some(TokenTree::Group(names)) => group = in_braces(names),
                        _ => {}
                    }
                    if !matches!(tokens.get(at + 3), Some(TokenTree::Ident(_))) {
                        break;
                    }
                    at += 3;
                }
                match group {
                    Some(tree) => named_by_use(&tree, &path, &mut |_, path| paths.push(path)),
                    None if path.len() > 1 => paths.push(path),
                    None => {}
                }
            }
            _ => {}
        }
        at += 1;
    }
}

/// What a `use` inside a function names in braces.
fn in_braces(names: &Group) -> Option<UseTree> {
    let is_use = names.delimiter() == Delimiter::Brace;
    is_use.then(|| syn::parse2(names.to_token_stream()).ok())?
}

#[test]
fn no_modules_form_a_circle() {
    let mut modules = 0;
    let mut circles = Vec::new();
    for folder in std::fs::read_dir(root().join("crates")).unwrap() {
        let source = folder.unwrap().path().join("src");
        let read = Modules::of_crate(&source);
        modules += read.0.len();
        let of_crate = read.circles();
        circles.extend(
            of_crate
                .iter()
                .map(|circle| format!("{}: {circle}", source.display())),
        );
    }
    assert!(modules > 700, "{modules}");
    assert!(circles.is_empty(), "{}", circles.join("\n"));
}

/// Modules that one at the place of a command names which lie in another command.
fn of_other_commands(modules: &Modules) -> Vec<String> {
    let of_another = |(module, target, _): &(&Names, Names, &Names)| {
        // `answers` is what the crate shows of them.
        let is_above = |name: &String| name == "commands" || name == "answers";
        let dispatch = module.len() < 2 && module.iter().all(is_above);
        let own = module.len() > 1 && module[0] == "commands" && target.get(1) == module.get(1);
        !dispatch && target.len() > 1 && target[0] == "commands" && !own
    };
    let said = |(module, target, _): (&Names, Names, &Names)| {
        format!("{} imports {}", module.join("::"), target.join("::"))
    };
    modules.named().filter(of_another).map(said).collect()
}

/// What several commands need lies beside `commands` or in a library.
#[test]
fn commands_do_not_import_one_another() {
    let modules = Modules::of_crate(&root().join("crates/cli/src"));
    let is_of_command = |name: &&Names| name.len() > 1 && name[0] == "commands";
    let commands = modules.0.keys().filter(is_of_command).count();
    assert!(commands > 40, "{commands}");
    assert_eq!(of_other_commands(&modules), [""; 0]);
}

/// A crate of these files.
fn of_files(files: &[(&str, &str)]) -> Modules {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }
    Modules::of_crate(folder.path())
}

#[test]
fn imports_of_commands_are_found() {
    let root = ("lib.rs", "mod commands; mod plot; use commands::gap::csv;");
    let all = (
        "commands/mod.rs",
        "mod compare; mod gap; use self::gap::csv;",
    );
    let gap = (
        "commands/gap.rs",
        "pub fn csv() {} use crate::plot::figure; use super::all;",
    );
    let plot = ("plot.rs", "pub fn figure() {}");
    let found = |text: &str, plot| {
        let compare = (
            "commands/compare/mod.rs",
            "mod files; mod text; pub struct Own;",
        );
        let both = [
            ("commands/compare/files.rs", text),
            ("commands/compare/text.rs", "pub fn a() {}"),
        ];
        of_other_commands(&of_files(
            &[&[root, all, gap, plot, compare], &both[..]].concat(),
        ))
    };
    let text = "use super::text::a; use super::{Own, text::a as b}; use crate::plot::figure;";
    assert_eq!(found(text, plot), [""; 0]);
    let expected = ["commands::compare::files imports commands::gap"];
    for text in [
        "use super::super::gap::csv;",
        "use crate::commands::gap;",
        "use super::super::{all, gap::{csv as b}};",
        "fn f() { vec![crate::commands::gap::csv()]; }",
    ] {
        assert_eq!(found(text, plot), expected, "{text}");
    }
    let other = ["plot imports commands::gap"];
    assert_eq!(
        found("", ("plot.rs", "use crate::commands::gap::csv;")),
        other
    );
}

#[test]
fn circles_are_found() {
    let read = |files: &[(&str, &str)]| of_files(files).circles();
    let root = ("lib.rs", "mod a; mod b; pub use b::B;");
    let upper = ("a.rs", "use crate::B; pub fn a(_: B) {}");
    assert!(read(&[root, upper, ("b.rs", "pub struct B;")]).is_empty());
    let back = "pub struct B; fn b() { vec![crate::a::a(B)]; }";
    let circle = "a, b:\n  a names crate::B\n  b names crate::a::a";
    assert_eq!(read(&[root, upper, ("b.rs", back)]), [circle]);
    // Not those of a module with what lies inside it, and not those of tests.
    let parent = ("a/mod.rs", "mod c; fn a() { c::c() }");
    let child = ("a/c.rs", "pub fn c() { super::a() }");
    let tests = "pub struct B; #[cfg(test)] mod tests { use crate::a; }";
    assert!(read(&[root, parent, child, ("b.rs", tests)]).is_empty());
    // By what lies inside them, and in braces of a function.
    let child = ("a/c.rs", "pub fn c() { use crate::{b::{self as d}}; }");
    let back = "pub struct B; use crate::a::{a as e};";
    let found = read(&[root, parent, child, ("b.rs", back)]);
    let circle = "a, b:\n  a::c names crate::b\n  b names crate::a::a";
    assert_eq!(found, [circle]);
}
