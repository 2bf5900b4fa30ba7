//! From the text of a rule to its tree: the text is an expression of the Common Expression
//! Language, whose parser gives its tree with places; names and dimensions are checked here.

use std::ops::Range;
use std::sync::Arc;

use cel::common::ast::{CallExpr, Expr, IdedExpr, LiteralValue, SourceInfo, operators};
use cel::parser::{ParseErrors, Parser};

use super::OwnRule;
use super::kind::Kind;
use super::names::{self, Named};
use super::table::Table;
use super::tree::{Function, Node, Operator, Part};
use crate::inputs::StructuralSystem;
use pounding_case::{CaseError, Dimension, Located, RuleText};
use pounding_catalogue::suggestion;

/// Most characters of an expression or a definition.
const MOST_CHARACTERS: usize = 2000;
/// Most operations below one another, counted through definitions.
const MOST_NESTED: usize = 100;
/// Most brackets and `?` within one another: the parser calls itself for each, and each takes much of
/// its stack.
const DEEPEST: usize = 32;
/// Stack of the parser (bytes): some ten times what so many brackets take of it, without
/// optimisation.
#[cfg(not(target_family = "wasm"))]
const STACK: usize = 64 << 20;
/// Most inputs, tables or definitions of a rule.
const MOST_NAMES: usize = 50;

/// Words of the Common Expression Language that are no names there, in its specification.
const RESERVED: [&str; 21] = [
    "as",
    "break",
    "const",
    "continue",
    "else",
    "false",
    "for",
    "function",
    "if",
    "import",
    "in",
    "let",
    "loop",
    "namespace",
    "null",
    "package",
    "return",
    "true",
    "var",
    "void",
    "while",
];

/// A rule with all that is checked of it.
pub(super) fn compile(text: &RuleText) -> Result<OwnRule, CaseError> {
    let mut compiler = Compiler::of(text)?;
    let mut whole = Text::of(&text.expression, "expression", text);
    let expression = compiler.whole(&mut whole, 0);
    let unused = compiler.unused();
    let (expression, unused) = match (expression, unused) {
        (Ok(expression), Ok(unused)) => (expression, unused),
        (expression, unused) => {
            let errors = [expression.err(), unused.err()];
            let all = CaseError::of_all(errors.into_iter().flatten().collect());
            return Err(all.unwrap_or_else(|| whole.error(0..0, "this is no rule", NAME_PARTS)));
        }
    };
    match expression.kind {
        Kind::Zero => {}
        Kind::Number(dimension) if dimension == Dimension::LENGTH => {}
        found => {
            let at = expression.at.clone();
            let message = format!("the result is {}, and must be a length", described(found));
            let help = match found {
                Kind::Number(d) if d == Dimension::NUMBER => {
                    "a length stands with its unit in `inputs`, and its name in the expression: expression = \"w\" with inputs = { w = \"100 mm\" }"
                }
                _ => {
                    "write an expression of lengths, such as expression = \"max(0.01 * height, w)\" with inputs = { w = \"100 mm\" }"
                }
            };
            return Err(whole.error(at, message, help));
        }
    }
    Ok(OwnRule {
        unused,
        ..compiler.finish(expression)
    })
}

/// An expression of numbers that has a number as its result.
pub(super) fn numbers(expression: &str) -> Result<OwnRule, CaseError> {
    let written = |value: &str| Located {
        value: value.to_owned(),
        span: 0..value.len(),
    };
    let text = RuleText {
        name: written("arithmetic"),
        region: String::new(),
        edition: String::new(),
        clause: String::new(),
        between: true,
        expression: written(expression),
        inputs: Vec::new(),
        tables: Vec::new(),
        definitions: Vec::new(),
        assumptions: Vec::new(),
        file: Arc::from("expression"),
        source: Arc::from(expression),
    };
    let mut compiler = Compiler::of(&text)?;
    let mut whole = Text::of(&text.expression, "expression", &text);
    let expression = compiler.whole(&mut whole, 0)?;
    if !matches!(expression.kind, Kind::Number(d) if d == Dimension::NUMBER) {
        let at = expression.at.clone();
        return Err(whole.error(at, "this is no number", "write numbers alone"));
    }
    Ok(compiler.finish(expression))
}

/// What a kind is called in messages.
fn described(kind: Kind) -> String {
    match kind {
        Kind::Number(dimension) => dimension.to_string(),
        Kind::Zero => "zero".to_owned(),
        Kind::Truth => "true or false".to_owned(),
        Kind::Word => "a word".to_owned(),
    }
}

/// A text that is compiled: the expression or a definition.
struct Text<'t> {
    rule: &'t RuleText,
    written: &'t Located<String>,
    /// What it is, in messages.
    what: String,
    places: SourceInfo,
}

impl<'t> Text<'t> {
    fn of(written: &'t Located<String>, what: &str, rule: &'t RuleText) -> Self {
        Self {
            rule,
            written,
            what: what.to_owned(),
            places: SourceInfo::default(),
        }
    }

    /// Where a node starts and ends: of an operation its operator, of a call its name.
    fn at(&self, node: &IdedExpr) -> Range<usize> {
        let length = self.written.value.len();
        let (start, last) = self.places.offset_for(node.id).unwrap_or_default();
        let (start, end) = (start as usize, last as usize + 1);
        let start = start.min(length);
        let Expr::Call(call) = &node.expr else {
            return start..end.clamp(start, length);
        };
        // The parser marks the parenthesis of a call.
        let before = self.written.value.get(..start).unwrap_or_default();
        match before.trim_end().strip_suffix(call.func_name.as_str()) {
            Some(name) => name.len()..name.len() + call.func_name.len(),
            None => start..end.clamp(start, length),
        }
    }

    /// The token that starts at a byte: a name, a number, or one character.
    fn token(&self, start: usize) -> Range<usize> {
        let rest = self.written.value.get(start..).unwrap_or_default();
        let of_word = |c: &char| c.is_alphanumeric() || matches!(c, '_' | '.');
        let length: usize = rest.chars().take_while(of_word).map(char::len_utf8).sum();
        let one = rest.chars().next().map_or(0, char::len_utf8);
        start..start + length.max(one)
    }

    /// Byte of a line and a column, both from 1.
    fn byte(&self, (line, column): (isize, isize)) -> usize {
        let lines = self.written.value.split_inclusive('\n');
        let before: usize = lines
            .take(usize::try_from(line - 1).unwrap_or(0))
            .map(str::len)
            .sum();
        let column = usize::try_from(column - 1).unwrap_or(0);
        (before + column).min(self.written.value.len())
    }

    /// An error at a part of the text, at its place in the file.
    fn error(&self, at: Range<usize>, message: impl Into<String>, help: &str) -> CaseError {
        let Located { value, span } = self.written;
        let literal = self.rule.source.get(span.clone()).unwrap_or_default();
        // Where escapes stand between, the whole text is pointed at.
        let place = literal.find(value.as_str()).map(|quotes| {
            let start = span.start + quotes;
            start + at.start..start + at.end
        });
        let part = value.get(at.clone()).unwrap_or_default();
        let message = message.into();
        let message = match part {
            "" => format!(
                "rule \"{}\", {}: {message}",
                self.rule.name.value, self.what
            ),
            part => format!(
                "rule \"{}\", {}: {message}, at `{}`",
                self.rule.name.value,
                self.what,
                shortened(part)
            ),
        };
        let place = place.unwrap_or_else(|| span.clone());
        self.rule.error(place, message, Some(help.to_owned()))
    }
}

/// No more of a text than fits in a line.
pub(super) fn shortened(text: &str) -> String {
    let plain = text.split_whitespace().collect::<Vec<_>>().join(" ");
    if plain.chars().count() <= 40 {
        return plain;
    }
    let start: String = plain.chars().take(37).collect();
    format!("{start}...")
}

/// Whether a definition has been compiled.
#[derive(Clone, PartialEq)]
enum State {
    Untouched,
    /// Something that it needs is being compiled.
    Open,
    /// Its place among those that are compiled.
    Done(usize),
    /// What is wrong in it.
    Wrong(CaseError),
}

struct Compiler<'t> {
    text: &'t RuleText,
    inputs: Vec<(String, f64, Dimension)>,
    tables: Vec<(String, Table)>,
    definitions: Vec<(String, Part)>,
    states: Vec<State>,
    needs: Vec<Named>,
    /// Inputs and tables that a text names.
    used: Vec<String>,
}

impl<'t> Compiler<'t> {
    fn of(text: &'t RuleText) -> Result<Self, CaseError> {
        let mut known: Vec<&str> = Vec::new();
        let names = text.inputs.iter().map(|(name, _)| name);
        let names = names.chain(text.tables.iter().map(|(name, _)| name));
        let names = names.chain(text.definitions.iter().map(|(name, _)| name));
        for name in names {
            let refuse = |message: String, help: &str| {
                Err(text.error(name.span.clone(), message, Some(help.to_owned())))
            };
            let word = name.value.as_str();
            let letters = |c: char| c.is_ascii_alphanumeric() || c == '_';
            let begins = word.starts_with(|c: char| c.is_ascii_alphabetic());
            if !(begins && word.chars().all(letters)) {
                let message = format!("\"{}\" cannot be a name", shortened(word));
                return refuse(message, "letters, digits and `_`, a letter first");
            }
            if RESERVED.contains(&word) {
                let message = format!("\"{word}\" is a word of the language of expressions");
                return refuse(message, "choose another name");
            }
            let taken = names::all(true)
                .iter()
                .chain(&names::all(false))
                .any(|n| n == word)
                || Function::of(word).is_some();
            if taken {
                let message = format!("\"{word}\" has a meaning already");
                return refuse(message, "choose another name");
            }
            if known.contains(&word) {
                let message = format!("\"{word}\" stands twice in the rule");
                return refuse(message, "choose another name");
            }
            known.push(word);
        }
        if known.len() > MOST_NAMES {
            let message = format!(
                "the rule has {} inputs, tables and definitions; {MOST_NAMES} are allowed",
                known.len()
            );
            let span = text.name.span.clone();
            return Err(text.error(span, message, Some("use fewer".to_owned())));
        }
        let inputs = text.inputs.iter().map(|(name, quantity)| {
            let dimension = quantity.dimension.unwrap_or(Dimension::NUMBER);
            (name.value.clone(), quantity.value, dimension)
        });
        let tables = text.tables.iter();
        let tables = tables.map(|(name, table)| Ok((name.value.clone(), Table::of(text, table)?)));
        Ok(Self {
            text,
            inputs: inputs.collect(),
            tables: tables.collect::<Result<_, CaseError>>()?,
            definitions: Vec::new(),
            states: vec![State::Untouched; text.definitions.len()],
            needs: Vec::new(),
            used: Vec::new(),
        })
    }

    /// Names that the expression does not take, by itself or through a definition. Definitions among them are
    /// checked all the same, and count for nothing.
    fn unused(&mut self) -> Result<Vec<String>, CaseError> {
        let text = self.text;
        let used = self.used.clone();
        let (needs, kept) = (self.needs.clone(), self.definitions.len());
        let states = self.states.clone();
        let mut unused: Vec<String> = Vec::new();
        let mut errors = Vec::new();
        for (i, (name, _)) in text.definitions.iter().enumerate() {
            if states[i] == State::Untouched {
                let whole = Text::of(&text.expression, "expression", text);
                errors.extend(self.definition(&whole, i, &(0..0), 0).err());
                unused.push(name.value.clone());
            }
        }
        if let Some(error) = CaseError::of_all(errors) {
            return Err(error);
        }
        self.needs = needs;
        self.definitions.truncate(kept);
        let inputs = text.inputs.iter().map(|(name, _)| &name.value);
        let tables = text.tables.iter().map(|(name, _)| &name.value);
        unused.extend(
            inputs
                .chain(tables)
                .filter(|name| !used.contains(name))
                .cloned(),
        );
        Ok(unused)
    }

    fn finish(self, expression: Part) -> OwnRule {
        OwnRule {
            text: self.text.clone(),
            inputs: self.inputs,
            tables: self.tables,
            definitions: self.definitions,
            expression,
            needs: self.needs,
            unused: Vec::new(),
        }
    }

    /// The tree of a whole text, so many parts below another.
    fn whole(&mut self, text: &mut Text<'_>, level: usize) -> Result<Part, CaseError> {
        let tree = parsed(text)?;
        let part = self.part(text, &tree, level)?;
        // A name or a number is no operation.
        if part.depth > MOST_NESTED + 1 {
            return Err(text.error(0..0, too_deep(), NAME_PARTS));
        }
        Ok(part)
    }

    fn part(&mut self, text: &Text<'_>, node: &IdedExpr, level: usize) -> Result<Part, CaseError> {
        let here = text.at(node);
        if level > MOST_NESTED {
            return Err(text.error(here, too_deep(), NAME_PARTS));
        }
        let number = |value: f64| {
            if !value.is_finite() {
                return Err(text.error(here.clone(), "the number is not finite", "correct it"));
            }
            let kind = match value {
                0.0 => Kind::Zero,
                _ => Kind::Number(Dimension::NUMBER),
            };
            Ok(part(Node::Constant(value), kind, here.clone()))
        };
        match &node.expr {
            Expr::Literal(LiteralValue::Int(value)) => number(**value as f64),
            Expr::Literal(LiteralValue::UInt(value)) => number(**value as f64),
            Expr::Literal(LiteralValue::Double(value)) => number(**value),
            Expr::Literal(LiteralValue::Boolean(value)) => {
                Ok(part(Node::Truth(**value), Kind::Truth, here))
            }
            Expr::Literal(LiteralValue::String(word)) => word_of(text, word, here),
            Expr::Ident(name) => self.name(text, name, here, level),
            Expr::Call(call) if call.target.is_none() => self.called(text, call, here, level),
            _ => Err(text.error(
                here,
                "this cannot stand in an expression",
                "use names, numbers, operators and functions",
            )),
        }
    }

    /// An operation, a choice, a function or a table.
    fn called(
        &mut self,
        text: &Text<'_>,
        call: &CallExpr,
        here: Range<usize>,
        level: usize,
    ) -> Result<Part, CaseError> {
        let (mut arguments, mut errors) = (Vec::new(), Vec::new());
        for argument in &call.args {
            match self.part(text, argument, level + 1) {
                Ok(part) => arguments.push(part),
                Err(error) => errors.push(error),
            }
        }
        if let Some(error) = CaseError::of_all(errors) {
            return Err(error);
        }
        match call.func_name.as_str() {
            operators::CONDITIONAL => choice(text, arguments, here),
            operators::NEGATE => unary(text, "-", arguments, here),
            operators::LOGICAL_NOT => unary(text, "!", arguments, here),
            name => match Operator::of(name) {
                Some(operator) => operation(text, operator, arguments, here),
                None => self.function(text, name, arguments, here),
            },
        }
    }

    /// A name: a quantity of the case, an input or a definition of the rule.
    fn name(
        &mut self,
        text: &Text<'_>,
        name: &str,
        at: Range<usize>,
        level: usize,
    ) -> Result<Part, CaseError> {
        if let Some(i) = self.inputs.iter().position(|(known, ..)| known == name) {
            let kind = Kind::Number(self.inputs[i].2);
            self.used.push(name.to_owned());
            return Ok(part(Node::Input(i), kind, at));
        }
        let definitions = &self.text.definitions;
        if let Some(i) = definitions
            .iter()
            .position(|(known, _)| known.value == name)
        {
            let place = self.definition(text, i, &at, level)?;
            let (_, defined) = &self.definitions[place];
            let mut made = part(Node::Definition(place), defined.kind, at);
            made.depth = defined.depth + 1;
            return Ok(made);
        }
        match names::find(name, self.text.between) {
            Ok(Some(named)) => {
                if !self.needs.contains(&named) {
                    self.needs.push(named);
                }
                Ok(part(Node::Named(named), named.kind(), at))
            }
            Err(help) => Err(text.error(at, "this name does not stand here", &help)),
            Ok(None) => Err(self.unknown(text, name, at)),
        }
    }

    fn unknown(&self, text: &Text<'_>, name: &str, at: Range<usize>) -> CaseError {
        if name == self.text.name.value {
            return text.error(
                at,
                "a rule cannot need itself",
                "take it out of the expression",
            );
        }
        let callable = self.tables.iter().any(|(known, _)| known == name);
        if callable || Function::of(name).is_some() {
            let help = format!("write {name}(...)");
            return text.error(at, "this name stands for a function", &help);
        }
        let mut all = names::all(self.text.between);
        all.extend(self.inputs.iter().map(|(known, ..)| known.clone()));
        all.extend(
            self.text
                .definitions
                .iter()
                .map(|(known, _)| known.value.clone()),
        );
        let known: Vec<&str> = all.iter().map(String::as_str).collect();
        let help = match suggestion::misspelt(name, &known) {
            Some(meant) => format!("did you mean `{meant}`?"),
            None => format!("known are {}", known.join(", ")),
        };
        text.error(at, "this name is not known", &help)
    }

    /// The place of a definition among those that are compiled.
    fn definition(
        &mut self,
        from: &Text<'_>,
        i: usize,
        at: &Range<usize>,
        level: usize,
    ) -> Result<usize, CaseError> {
        let (name, written) = &self.text.definitions[i];
        match &self.states[i] {
            State::Done(place) => return Ok(*place),
            State::Wrong(error) => return Err(error.clone()),
            State::Open => {
                return Err(from.error(
                    at.clone(),
                    format!("the definition \"{}\" needs itself", name.value),
                    "take the circle out of `definitions`",
                ));
            }
            State::Untouched => {}
        }
        self.states[i] = State::Open;
        let what = format!("definition \"{}\"", name.value);
        let mut text = Text::of(written, &what, self.text);
        let made = self.whole(&mut text, level + 1);
        let made = made.and_then(|made| match made.kind {
            Kind::Word => {
                Err(text.error(made.at, "a definition is no word", "compare it, with =="))
            }
            _ => Ok(made),
        });
        let made = made.inspect_err(|error| self.states[i] = State::Wrong(error.clone()))?;
        let place = self.definitions.len();
        self.definitions.push((name.value.clone(), made));
        self.states[i] = State::Done(place);
        Ok(place)
    }

    /// A function or a table.
    fn function(
        &mut self,
        text: &Text<'_>,
        name: &str,
        mut arguments: Vec<Part>,
        at: Range<usize>,
    ) -> Result<Part, CaseError> {
        let end = arguments.iter().map(|a| a.at.end).fold(at.end, usize::max);
        // The parenthesis that closes it.
        let close = text.written.value[end..]
            .find(')')
            .map_or(end, |i| end + i + 1);
        let whole = at.start..close;
        if let Some(i) = self.tables.iter().position(|(known, _)| known == name) {
            let [one] = arguments.as_mut_slice() else {
                return Err(text.error(
                    at,
                    "a table takes one quantity",
                    "write it in parentheses",
                ));
            };
            self.used.push(name.to_owned());
            let [over, value] = self.tables[i].1.dimensions;
            let fits =
                matches!(one.kind, Kind::Zero) || matches!(one.kind, Kind::Number(d) if d == over);
            if !fits {
                let message = format!(
                    "the table goes over {over}, and not over {}",
                    described(one.kind)
                );
                return Err(text.error(one.at.clone(), message, "give it that quantity"));
            }
            let one = arguments.remove(0);
            return Ok(part(
                Node::Table(i, Box::new(one)),
                Kind::Number(value),
                whole,
            ));
        }
        if !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
            // What the language calls an index, among others.
            return Err(text.error(
                at,
                "this cannot stand in an expression",
                "use names, numbers, operators and functions",
            ));
        }
        let Some(function) = Function::of(name) else {
            if name == self.text.name.value {
                return Err(text.error(at, "a rule cannot need itself", "take it out"));
            }
            let functions = Function::ALL.iter().map(|(known, _)| *known);
            let tables = self.tables.iter().map(|(known, _)| known.as_str());
            let known: Vec<&str> = functions.chain(tables).collect();
            let help = match suggestion::misspelt(name, &known) {
                Some(meant) => format!("did you mean `{meant}`?"),
                None => format!("known are {}", known.join(", ")),
            };
            return Err(text.error(at, "this function is not known", &help));
        };
        let count = arguments.len();
        let (enough, message) = match function {
            Function::Maximum | Function::Minimum => {
                (count >= 2, "it takes two quantities or more")
            }
            Function::Power => (count == 2, "it takes a base and an exponent"),
            _ => (count == 1, "it takes one quantity"),
        };
        if !enough {
            return Err(text.error(at, message, "separate them by commas"));
        }
        if function == Function::Power {
            let kind = power(text, &arguments[0], &arguments[1])?;
            return Ok(part(Node::Function(function, arguments), kind, whole));
        }
        let mut kind = arguments[0].kind;
        for argument in &arguments {
            if !matches!(argument.kind, Kind::Number(_) | Kind::Zero) {
                let message = format!(
                    "`{name}` takes quantities, and not {}",
                    described(argument.kind)
                );
                return Err(text.error(argument.at.clone(), message, "give it a quantity"));
            }
            let first = Part {
                kind,
                ..arguments[0].clone()
            };
            kind = same(text, &first, argument, &format!("stand in one `{name}`"))?;
        }
        kind = match (function, kind) {
            (Function::SquareRoot, Kind::Number(d)) => Kind::Number(to_the_power(d, 0.5)),
            (Function::Ceiling | Function::Floor, Kind::Number(d)) if d != Dimension::NUMBER => {
                let message = format!("`{name}` rounds pure numbers, and not {d}");
                return Err(text.error(arguments[0].at.clone(), message, "divide by a step first"));
            }
            (_, kind) => kind,
        };
        Ok(part(Node::Function(function, arguments), kind, whole))
    }
}

/// What to do with an expression that is too long or too deep.
const NAME_PARTS: &str = "give parts of it names in `definitions`";

fn too_deep() -> String {
    format!("more than {MOST_NESTED} operations nest in one another")
}

/// The tree of a text, with places in `places`.
fn parsed(text: &mut Text<'_>) -> Result<IdedExpr, CaseError> {
    let source = &text.written.value;
    let length = source.chars().count();
    if length > MOST_CHARACTERS {
        let message = format!("{length} characters are too many; {MOST_CHARACTERS} are allowed");
        return Err(text.error(0..0, message, NAME_PARTS));
    }
    // Places are counted in characters by the parser, in bytes here.
    if let Some((at, strange)) = source.char_indices().find(|(_, c)| !c.is_ascii()) {
        let message = format!("`{strange}` cannot stand in an expression");
        let end = at + strange.len_utf8();
        return Err(text.error(
            at..end,
            message,
            "use letters from a to z, digits and operators",
        ));
    }
    if let Some(at) = source.find('^') {
        let message = "`^` is no operator";
        return Err(text.error(at..at + 1, message, "write pow(x, 2) for a power"));
    }
    if let Some((place, message, help)) = foreign(source) {
        return Err(text.error(place, message, help));
    }
    if let Some(at) = deepest(source) {
        let message = format!("more than {DEEPEST} brackets or `?` nest in one another");
        return Err(text.error(at..at + 1, message, NAME_PARTS));
    }
    let owned = source.clone();
    let parse = move || Parser::default().parse_with_source_info(&owned);
    // A page has no threads: its stack is long enough for what is allowed above.
    #[cfg(target_family = "wasm")]
    let answer = parse();
    #[cfg(not(target_family = "wasm"))]
    let answer = {
        let parser = std::thread::Builder::new().stack_size(STACK);
        let running = parser.spawn(parse).map_err(|e| {
            let message = format!("there is no thread to read the expression: {e}");
            text.error(0..0, message, "end other programs, and try again")
        })?;
        let Ok(answer) = running.join() else {
            return Err(text.error(0..0, "this cannot be read as an expression", "simplify it"));
        };
        answer
    };
    let (tree, places) = answer.map_err(|errors| unreadable(text, &errors))?;
    text.places = places;
    Ok(tree)
}

/// The bytes of a text that stand in no quotation marks, with their places.
fn unquoted(source: &str) -> impl Iterator<Item = (usize, u8)> {
    // The quotation mark of a word that has begun, and whether its next character is taken as it is.
    let (mut quoted, mut escaped) = (None, false);
    source.bytes().enumerate().filter(move |(_, byte)| {
        if let Some(mark) = quoted {
            if *byte == mark && !escaped {
                quoted = None;
            }
            escaped = *byte == b'\\' && !escaped;
            return false;
        }
        if matches!(byte, b'"' | b'\'') {
            quoted = Some(*byte);
            return false;
        }
        true
    })
}

/// What the language takes besides and an engineer means otherwise or not at all: where it stands, what is said of it, and
/// what to do. `//` begins a comment there, of which the rest of the expression would be one.
fn foreign(source: &str) -> Option<(Range<usize>, String, &'static str)> {
    let mut before = b' ';
    for (at, byte) in unquoted(source) {
        let rest = &source.as_bytes()[at..];
        if rest.starts_with(b"//") {
            let message = "`//` is no operator".to_owned();
            let help = "write / for a quotient, floor(a / b) for a whole one; comments stand behind `#` in the file";
            return Some((at..at + 2, message, help));
        }
        let starts =
            byte.is_ascii_digit() && !(before.is_ascii_alphanumeric() || b"_.".contains(&before));
        before = byte;
        if !starts {
            continue;
        }
        let digits = rest
            .iter()
            .take_while(|b| b.is_ascii_alphanumeric())
            .count();
        let number = &source[at..at + digits];
        let is_hexadecimal = number.starts_with("0x") || number.starts_with("0X");
        if is_hexadecimal || number.ends_with(['u', 'U']) {
            let message = format!("`{number}` is no number");
            return Some((
                at..at + digits,
                message,
                "write decimal digits alone, as 10 or 0.5",
            ));
        }
    }
    None
}

/// Where brackets and `?` nest more deeply than is allowed. Those of a bracket that is closed, or of
/// an argument that is complete, nest in nothing that follows.
fn deepest(source: &str) -> Option<usize> {
    // The `?` of the text and of every bracket that is open, and those of all together.
    let mut open = vec![0_usize];
    let mut choices = 0;
    for (at, byte) in unquoted(source) {
        let brackets = open.len() - 1;
        match byte {
            b'(' | b'[' | b'{' => open.push(0),
            b')' | b']' | b'}' if brackets > 0 => choices -= open.pop().unwrap_or(0),
            b',' => choices -= open.last_mut().map_or(0, std::mem::take),
            b'?' => {
                if let Some(of) = open.last_mut() {
                    *of += 1;
                }
                choices += 1;
            }
            _ => {}
        }
        if open.len() - 1 + choices > DEEPEST {
            return Some(at);
        }
    }
    None
}

/// What the parser says of a text that is no expression.
fn unreadable(text: &Text<'_>, errors: &ParseErrors) -> CaseError {
    let help = "use names, numbers, + - * / %, comparisons, && || !, functions, and condition ? this : that; numbers with a unit stand in `inputs`, such as w = \"100 mm\"";
    let Some(first) = errors.errors.first() else {
        return text.error(0..0, "this is no expression", help);
    };
    let at = text.token(text.byte(first.pos));
    let message = first.msg.trim_start_matches("Syntax error: ");
    let message = message.split(" expecting {").next().unwrap_or(message);
    if message.contains("'<EOF>'") && at.is_empty() {
        return text.error(at, "it ends too early", "complete it");
    }
    if message.starts_with("invalid int literal") {
        let message = "the whole number has too many digits";
        return text.error(at, message, "write it with an exponent, such as 1.0e20");
    }
    if message.contains("Recursion limit") {
        return text.error(0..0, too_deep(), NAME_PARTS);
    }
    // The parser's own words for a part that it could not complete.
    if message.starts_with("No `") {
        return text.error(at, "this is no expression", help);
    }
    text.error(at, message, help)
}

/// The word that a kind of structure is compared with.
fn word_of(text: &Text<'_>, word: &str, at: Range<usize>) -> Result<Part, CaseError> {
    if StructuralSystem::from_name(word).is_none() {
        let known: Vec<_> = StructuralSystem::ALL.iter().map(|s| s.name()).collect();
        let message = format!("\"{}\" is no structural system", shortened(word));
        let help = match word.trim().parse::<f64>() {
            Ok(_) => format!(
                "write a number without quotes, as {}",
                shortened(word.trim())
            ),
            Err(_) => format!(
                "known ones are {}; a soil zone is a number, 1, 2 or 3",
                known.join(", ")
            ),
        };
        return Err(text.error(at, message, &help));
    }
    Ok(part(Node::Word(word.to_owned()), Kind::Word, at))
}

/// `condition ? this : that`.
fn choice(text: &Text<'_>, parts: Vec<Part>, at: Range<usize>) -> Result<Part, CaseError> {
    let Ok([condition, yes, no]) = <[Part; 3]>::try_from(parts) else {
        return Err(text.error(
            at,
            "`?` needs two alternatives",
            "write a < b ? this : that",
        ));
    };
    if condition.kind != Kind::Truth {
        let message = format!(
            "`?` asks for true or false, and not for {}",
            described(condition.kind)
        );
        return Err(text.error(condition.at, message, "compare two quantities"));
    }
    let kind = same(text, &yes, &no, "be alternatives")?;
    let at = condition.at.start..no.at.end;
    Ok(part(Node::Choice(Box::new([condition, yes, no])), kind, at))
}

/// A minus before a quantity, or a `!` before what is true or false.
fn unary(
    text: &Text<'_>,
    symbol: &str,
    parts: Vec<Part>,
    at: Range<usize>,
) -> Result<Part, CaseError> {
    let Some(one) = parts.into_iter().next() else {
        return Err(text.error(at, "nothing follows", "complete it"));
    };
    let kind = one.kind;
    let numeric = matches!(kind, Kind::Number(_) | Kind::Zero);
    let whole = at.start.min(one.at.start)..one.at.end;
    match symbol {
        "-" if numeric => Ok(part(Node::Negative(Box::new(one)), kind, whole)),
        "!" if kind == Kind::Truth => Ok(part(Node::Not(Box::new(one)), kind, whole)),
        _ => {
            let message = format!("`{symbol}` does not go with {}", described(kind));
            Err(text.error(whole, message, "correct it"))
        }
    }
}

fn part(node: Node, kind: Kind, at: Range<usize>) -> Part {
    let below = match &node {
        Node::Negative(one) | Node::Not(one) | Node::Table(_, one) => one.depth,
        Node::Operation(_, two) => two[0].depth.max(two[1].depth),
        Node::Choice(three) => three.iter().map(|p| p.depth).max().unwrap_or(0),
        Node::Function(_, all) => all.iter().map(|p| p.depth).max().unwrap_or(0),
        _ => 0,
    };
    Part {
        node,
        kind,
        at,
        depth: below + 1,
    }
}

fn both(operator: Operator, left: Part, right: Part, kind: Kind) -> Part {
    let at = left.at.start.min(right.at.start)..left.at.end.max(right.at.end);
    part(Node::Operation(operator, Box::new([left, right])), kind, at)
}

/// A power of a dimension.
fn to_the_power(dimension: Dimension, power: f64) -> Dimension {
    Dimension {
        mass: power * dimension.mass,
        length: power * dimension.length,
        time: power * dimension.time,
    }
}

/// The dimension of a product, or of a quotient with `power` -1.
fn times(a: Dimension, b: Dimension, power: f64) -> Dimension {
    Dimension {
        mass: a.mass + power * b.mass,
        length: a.length + power * b.length,
        time: a.time + power * b.time,
    }
}

/// The kind of two parts that must be of one kind.
fn same(text: &Text<'_>, left: &Part, right: &Part, what: &str) -> Result<Kind, CaseError> {
    match (left.kind, right.kind) {
        (Kind::Zero, Kind::Number(d)) | (Kind::Number(d), Kind::Zero) => Ok(Kind::Number(d)),
        (Kind::Number(a), Kind::Number(b)) if a == b => Ok(left.kind),
        (a, b) if a == b && !matches!(a, Kind::Number(_)) => Ok(a),
        (a, b) => {
            let message = format!("{} and {} cannot {what}", described(a), described(b));
            let at = left.at.start.min(right.at.start)..left.at.end.max(right.at.end);
            let help = "give numbers with a unit as `inputs`, such as least = \"30 mm\"";
            Err(text.error(at, message, help))
        }
    }
}

fn operation(
    text: &Text<'_>,
    operator: Operator,
    parts: Vec<Part>,
    here: Range<usize>,
) -> Result<Part, CaseError> {
    let refuse = |at: Range<usize>, message: String, help: &str| Err(text.error(at, message, help));
    let Ok([first, second]) = <[Part; 2]>::try_from(parts) else {
        return refuse(
            here,
            "this cannot stand in an expression".to_owned(),
            "complete it",
        );
    };
    let symbol = operator.symbol();
    let numeric = |p: &&Part| matches!(p.kind, Kind::Number(_) | Kind::Zero);
    let both_parts = [&first, &second];
    let kind = match operator {
        Operator::And | Operator::Or => {
            if let Some(other) = both_parts.into_iter().find(|p| p.kind != Kind::Truth) {
                let message = format!(
                    "`{symbol}` asks for true or false, and not for {}",
                    described(other.kind)
                );
                return refuse(other.at.clone(), message, "compare two quantities");
            }
            Kind::Truth
        }
        Operator::Equal | Operator::NotEqual => {
            same(text, &first, &second, "be compared")?;
            Kind::Truth
        }
        _ => {
            if let Some(other) = both_parts.into_iter().find(|p| !numeric(p)) {
                let message = format!("`{symbol}` does not go with {}", described(other.kind));
                return refuse(other.at.clone(), message, "give it quantities");
            }
            match operator {
                Operator::Add => same(text, &first, &second, "be added")?,
                Operator::Subtract => same(text, &first, &second, "be subtracted")?,
                Operator::Remainder => same(text, &first, &second, "stand at `%`")?,
                Operator::Multiply | Operator::Divide => {
                    let divides = operator == Operator::Divide;
                    match (first.kind, second.kind) {
                        (_, Kind::Zero) if divides => {
                            let message = "this divides by zero".to_owned();
                            return refuse(second.at, message, "correct the divisor");
                        }
                        (Kind::Number(a), Kind::Number(b)) => {
                            Kind::Number(times(a, b, if divides { -1.0 } else { 1.0 }))
                        }
                        _ => Kind::Zero,
                    }
                }
                _ => {
                    same(text, &first, &second, "be compared")?;
                    Kind::Truth
                }
            }
        }
    };
    Ok(both(operator, first, second, kind))
}

fn power(text: &Text<'_>, base: &Part, exponent: &Part) -> Result<Kind, CaseError> {
    if !matches!(base.kind, Kind::Zero | Kind::Number(_)) {
        let message = format!("{} has no powers", described(base.kind));
        return Err(text.error(base.at.clone(), message, "give it a quantity"));
    }
    if !matches!(exponent.kind, Kind::Zero | Kind::Number(_))
        || matches!(exponent.kind, Kind::Number(d) if d != Dimension::NUMBER)
    {
        let message = format!(
            "an exponent is a pure number, and not {}",
            described(exponent.kind)
        );
        return Err(text.error(exponent.at.clone(), message, "divide it by a reference"));
    }
    let Kind::Number(dimension) = base.kind else {
        return Ok(base.kind);
    };
    if dimension == Dimension::NUMBER {
        return Ok(base.kind);
    }
    match constant(exponent) {
        Some(value) => Ok(Kind::Number(to_the_power(dimension, value))),
        None => Err(text.error(
            exponent.at.clone(),
            format!("the exponent of {dimension} must be a number that is written out"),
            "write it as a number, or divide the base by a reference",
        )),
    }
}

/// The value of a part that is made of numbers alone.
fn constant(part: &Part) -> Option<f64> {
    match &part.node {
        Node::Constant(value) => Some(*value),
        Node::Negative(one) => Some(-constant(one)?),
        Node::Operation(Operator::Divide, two) => {
            let value = constant(&two[0])? / constant(&two[1])?;
            value.is_finite().then_some(value)
        }
        _ => None,
    }
}
