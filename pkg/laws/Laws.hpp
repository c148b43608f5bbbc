// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Tables of laws: one a family, one row a law. Names are written there and nowhere else: choices by name, the texts of
/// refusals, the choices of case files and the listings in Python come from the table.
///
/// A row is a struct of the family's own. It has the members
///
///     const char* name    as engines and case files call the law
///     const char* doc     what it is, with its source or equation, in one line
///     const char* range   where it holds, in one line: the end of a sentence "... for"
///
/// a type Law (the family's enum) and the functions of the law. A law is known by the number of its row. The enum names
/// the rows that code asks for by name; a law that nothing asks for needs no entry there.

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace capfrac {

template <class Row> class LawTable {
public:
	using Law = typename Row::Law;

	/// `attribute`: what engines call the choice, as refusals name it.
	LawTable(std::string attribute, std::vector<Row> rows)
	        : choice(std::move(attribute))
	        , laws(std::move(rows))
	{
	}

	/// The row of a law. Throws std::out_of_range where the table has none.
	const Row& operator[](Law law) const { return laws.at(static_cast<std::size_t>(law)); }

	/// The law of that name. Throws std::invalid_argument naming the attribute and all names that there are.
	Law fromName(const std::string& name) const
	{
		for (std::size_t k = 0; k < laws.size(); ++k)
			if (name == laws[k].name) return static_cast<Law>(k);
		throw std::invalid_argument(choice + " = '" + name + "', allowed: " + names());
	}

	/// "'a', 'b'": the names of all rows for which `which` holds, with `between` in between.
	template <class Which> std::string namesIf(Which which, const std::string& between = ", ") const
	{
		std::string all;
		for (const auto& law : laws)
			if (which(law)) all += (all.empty() ? "'" : between + "'") + law.name + "'";
		return all;
	}
	std::string names() const
	{
		return namesIf([](const Row&) { return true; });
	}

	/// Name and documentation of each law: what it is, "for" where it holds.
	std::vector<std::pair<std::string, std::string>> listing() const
	{
		std::vector<std::pair<std::string, std::string>> all;
		for (const auto& law : laws)
			all.emplace_back(law.name, std::string(law.doc) + ", for " + law.range);
		return all;
	}

	/// This table and one row more, at its end.
	LawTable with(const Row& law) const
	{
		auto more = *this;
		more.laws.push_back(law);
		return more;
	}

	const std::string& attribute() const { return choice; }
	auto begin() const { return laws.begin(); }
	auto end() const { return laws.end(); }

private:
	std::string choice;
	std::vector<Row> laws;
};

} // namespace capfrac
